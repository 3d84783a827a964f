// SPDX-License-Identifier: MIT
// Horizon-based ambient occlusion: what C++ and the shader share.
#ifndef LUXEL_HBAO_PARAMS_H
#define LUXEL_HBAO_PARAMS_H
#include "techniques/common/horizon.h"
LUXEL_BEGIN

struct HbaoParams {
    OcclusionParams occlusion;
    int slices;
    int steps;     // points on each side of a slice
    float bias;    // sine by which horizons must rise above the tangent plane
    float falloff; // 1: weight of a point 1 - (d/R)^2, 0: 1
};

LUXEL_END
#endif
