// SPDX-License-Identifier: MIT
// Parameters of the direct light pass: one batch of lights.
#ifndef LUXEL_FRAME_DIRECT_PARAMS_H
#define LUXEL_FRAME_DIRECT_PARAMS_H
#include "techniques/frame/shadow_params.h"
#include "techniques/frame/view_params.h"
LUXEL_BEGIN

LUXEL_CONST int MAX_BATCH_LIGHTS = 32;
LUXEL_CONST int MAX_BATCH_MAPS = 64;

struct DirectParams {
    ViewParams view;
    float esm_exponent;
    int light_count;
    float map_size; // texels a side
    ShadowedLight lights[MAX_BATCH_LIGHTS];
    ShadowView maps[MAX_BATCH_MAPS];
};

LUXEL_END
#endif
