// SPDX-License-Identifier: MIT
// Parameters of the log-space blur of exponential shadow maps.
#ifndef LUXEL_FRAME_ESM_PARAMS_H
#define LUXEL_FRAME_ESM_PARAMS_H
#include "techniques/frame/direct_params.h"
LUXEL_BEGIN

LUXEL_CONST int ESM_RADIUS = 4; // texels, two sigma
LUXEL_CONST float ESM_SIGMA = 2.0f;

struct EsmParams {
    ivec2 direction; // (1, 0) or (0, 1)
    float exponent;
    int maps;
    uint reversed; // the source holds reversed depth; otherwise linear
    ShadowView views[MAX_BATCH_MAPS];
};

LUXEL_FN float esm_weight(int i) { return exp(-0.5f * float(i * i) / (ESM_SIGMA * ESM_SIGMA)); }

LUXEL_END
#endif
