// SPDX-License-Identifier: MIT
#ifndef LUXEL_DISTANCE_MAP_PARAMS_H
#define LUXEL_DISTANCE_MAP_PARAMS_H
#include "techniques/common/cube_trace_params.h"
#include "techniques/frame/view_params.h"
LUXEL_BEGIN

LUXEL_CONST int DISTANCE_MAP_MAX_OBJECTS = 16;
LUXEL_CONST int DISTANCE_MAP_MAX_DEPTH = 8;

struct DistanceMapParams {
    ViewParams view;
    CubeTraceParams cube;
    int object;  // whose pixels are shaded: those that are in it more than in any other
    int objects; // 1: all specular pixels
    vec4 sphere[DISTANCE_MAP_MAX_OBJECTS]; // of each object: world center and radius
};

LUXEL_END
#endif
