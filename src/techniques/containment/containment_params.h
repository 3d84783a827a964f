// SPDX-License-Identifier: MIT
// Ambient occlusion by containment tests: what C++ and the shader share.
#ifndef LUXEL_CONTAINMENT_PARAMS_H
#define LUXEL_CONTAINMENT_PARAMS_H
#include "techniques/common/occlusion_params.h"
LUXEL_BEGIN

struct ContainmentParams {
    OcclusionParams occlusion;
};

LUXEL_END
#endif
