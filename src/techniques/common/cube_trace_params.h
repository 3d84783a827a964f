// SPDX-License-Identifier: MIT
// Tracing of rays in a layered distance cube.
#ifndef LUXEL_COMMON_CUBE_TRACE_PARAMS_H
#define LUXEL_COMMON_CUBE_TRACE_PARAMS_H
#include "shared/distance_search.h"
LUXEL_BEGIN

struct CubeTraceParams {
    vec3 center; // world
    int layers;
    int near_layers; // the first ones: specular surfaces; the others hold what is not specular
    DistanceSearch search;
    int depth;          // specular surfaces on a path, the first included
    float least_weight; // a branch that would add less than this share is not followed
    uint both;          // 1 = reflection and refraction, 0 = the greater of the two
};

struct CubeRangeParams {
    int layers;
    int near_layers;
    float near_most; // distance of the farthest point of the near layers, m
    float far_most;
};

LUXEL_END
#endif
