// SPDX-License-Identifier: MIT
// What the programs that draw displaced surfaces read.
#ifndef LUXEL_FRAME_DISPLACED_PARAMS_H
#define LUXEL_FRAME_DISPLACED_PARAMS_H
#include "shared/height_search.h"
#include "techniques/frame/peel_params.h"
LUXEL_BEGIN

struct DisplacedParams {
    PeelParams peel;
    HeightSearch search;
};

struct DisplacedDepthParams {
    mat4 world_to_clip;
    vec4 eye;         // homogeneous: where all rays come from, w > 0; w = 0: the direction they come from
    float handedness; // of the map's axes: 1 as the camera's, -1 where the map mirrors
    HeightSearch search;
};

LUXEL_END
#endif
