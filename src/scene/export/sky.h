// SPDX-License-Identifier: MIT
// Environments in other renderers' mappings.
#pragma once
#include "scene/scene.h"

namespace luxel {

// The world direction of a point of pbrt-v4's square, in [0, 1]^2: areas are kept [Clarberg2008].
glm::vec3 equal_area_direction(glm::vec2 square);

// The environment on that square, in radiance, rotation and scale in it; as many texels as the map has. Each
// is the mean over samples of its own area.
Image equal_area_sky(const Environment& environment);

// Degrees about +y that Mitsuba's envmap, whose border columns look along -z, is turned by.
float mitsuba_sky_angle(const Environment& environment);

} // namespace luxel
