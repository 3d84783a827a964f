// SPDX-License-Identifier: MIT
// Cameras for scenes without any, and cameras drawn by seed.
#pragma once
#include <cstdint>
#include <vector>

#include "scene/raycast.h"
#include "scene/scene.h"

namespace luxel {

// Three views from outside and above that frame the bounds, for scenes without cameras.
std::vector<Camera> default_cameras(const Scene& scene);

// `count` valid views drawn by seed inside the scene: sees geometry in at least 80 % of probe rays, not
// inside a wall (median distance above 2 % of the scene radius, few back faces), at most 60 % in one plane
// and 10 % emitters, a tenth or more of it reached by light directly or by one bounce, roughly horizontal.
// `rays` must be of `scene`. Error Fault::bad_input when none is found in a bounded number of tries.
std::vector<Camera> draw_views(const Scene& scene, const RayCaster& rays, int count, std::uint32_t seed);

} // namespace luxel
