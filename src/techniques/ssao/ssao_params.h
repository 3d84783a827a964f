// SPDX-License-Identifier: MIT
// Screen-space ambient occlusion: what C++ and the shader share.
#ifndef LUXEL_SSAO_PARAMS_H
#define LUXEL_SSAO_PARAMS_H
#include "techniques/common/occlusion_params.h"
LUXEL_BEGIN

struct SsaoParams {
    OcclusionParams occlusion;
};

LUXEL_END
#endif
