// SPDX-License-Identifier: MIT
// Alpha as coverage: a blended surface meets its share of the light, the rest passes as if it were not there.
#pragma once
#include "reference/random.h"
#include "scene/raycast.h"

namespace luxel {

struct Surface;

// The ray goes on behind the surface, which it has met at hit.t.
void go_behind(Ray& ray, const Hit& hit, const Surface& surface);

// The nearest surface, blended ones by chance. hit.t is from the ray's origin; surfaces were passed where
// `passed` is not 0, and then `ray` begins behind them, so far from where it began.
bool intersect_covered(const RayCaster& rays, Ray& ray, Hit& hit, Random& random, float& passed,
                       bool by_camera = false);

} // namespace luxel
