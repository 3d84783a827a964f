// SPDX-License-Identifier: MIT
// Clip volumes in world space: culling of bounds, and the part of a scene that a camera can see.
#pragma once
#include <array>
#include <vector>

#include "scene/scene.h"

namespace luxel {

// Inside: dot(plane, (p, 1)) >= 0 for all planes.
using Frustum = std::array<glm::vec4, 6>;
Frustum frustum_of(const glm::mat4& world_to_clip); // clip depth 0..w

// Conservative: may say yes to a box near a corner of the volume, never no to one that touches it.
bool touches(const Frustum& frustum, const Bounds& bounds);

// Vertices of the convex hull of box and frustum's common volume, `apex` (the frustum's tip) included if it
// is in the box. Empty when they have nothing in common.
std::vector<glm::vec3> common_corners(const Bounds& box, const Frustum& frustum, glm::vec3 apex);

} // namespace luxel
