// SPDX-License-Identifier: MIT
// Ground-truth ambient occlusion: what C++ and the shaders share, and the inner integrals.
#ifndef LUXEL_GTAO_PARAMS_H
#define LUXEL_GTAO_PARAMS_H
#include "techniques/common/horizon.h"
LUXEL_BEGIN

struct GtaoParams {
    OcclusionParams occlusion;
    int slices;
    int steps; // points on each side of a slice
};

// Integral over t in [0, h] of cos(t - gamma) sin t: one side of a slice that is open up to the angle h from
// the view direction, cosine weighted [Jimenez2016, eq. 7].
LUXEL_FN float gtao_arc(float h, float gamma) {
    return 0.25f * (-cos(2.0f * h - gamma) + cos(gamma) + 2.0f * h * sin(gamma));
}

// The same of (sin t, cos t): where the open directions point, along the tangent and the view.
LUXEL_FN vec2 gtao_bent_arc(float h, float gamma) {
    float across = 0.5f * (sin(h - gamma) + sin(gamma)) - (sin(3.0f * h - gamma) + sin(gamma)) / 12.0f -
                   0.25f * (sin(h + gamma) - sin(gamma));
    float along = (cos(gamma) - cos(3.0f * h - gamma)) / 12.0f + 0.25f * (cos(gamma) - cos(h + gamma));
    return vec2(across, along);
}

LUXEL_END
#endif
