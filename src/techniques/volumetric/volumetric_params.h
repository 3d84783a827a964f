// SPDX-License-Identifier: MIT
// Volumetric ambient occlusion: what C++ and the shader share.
#ifndef LUXEL_VOLUMETRIC_PARAMS_H
#define LUXEL_VOLUMETRIC_PARAMS_H
#include "techniques/common/occlusion_params.h"
LUXEL_BEGIN

struct VolumetricParams {
    OcclusionParams occlusion;
    uint analytic; // 1 = divide by the sphere's volume, 0 = by what the taps find of it
};

LUXEL_END
#endif
