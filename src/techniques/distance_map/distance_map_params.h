// SPDX-License-Identifier: MIT
#ifndef LUXEL_DISTANCE_MAP_PARAMS_H
#define LUXEL_DISTANCE_MAP_PARAMS_H
#include "techniques/common/cube_trace_params.h"
#include "techniques/frame/view_params.h"
LUXEL_BEGIN

LUXEL_CONST int DISTANCE_MAP_MAX_DEPTH = 8;

struct DistanceMapParams {
    ViewParams view;
    CubeTraceParams cube;
    CubeObjects objects;
};

LUXEL_END
#endif
