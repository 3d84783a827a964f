// SPDX-License-Identifier: MIT
// Paths from what a view shows through a layered distance cube.
#ifndef LUXEL_COMMON_CUBE_VIEW_PARAMS_H
#define LUXEL_COMMON_CUBE_VIEW_PARAMS_H
#include "techniques/common/cube_trace_params.h"
#include "techniques/frame/view_params.h"
LUXEL_BEGIN

LUXEL_CONST int CUBE_VIEW_MAX_DEPTH = 8;

struct CubeViewParams {
    ViewParams view;
    CubeTraceParams cube;
    CubeObjects objects;
    float least_weight; // a branch that would add less than this share is not followed
    uint both;          // 1 = reflection and refraction, 0 = the greater of the two
    float environment_rotation;
    float environment_scale; // of what rays show that leave the scene; 0 = black
};

LUXEL_END
#endif
