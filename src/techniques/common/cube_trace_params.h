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
    int depth; // specular surfaces on a path, the first included
};

// Which of several cubes a point of a specular surface belongs to: that of the object it is in more than in
// any other.
LUXEL_CONST int CUBE_MAX_OBJECTS = 16;
struct CubeObjects {
    int own;
    int count;
    vec4 sphere[CUBE_MAX_OBJECTS]; // world center and radius
};

struct CubeRangeParams {
    int layers;
    int near_layers;
    float near_most; // distance of the farthest point of the near layers, m
    float far_most;
};

LUXEL_FN bool is_own(CubeObjects o, vec3 position) {
    int nearest = 0;
    float least = 1e30f;
    for (int i = 0; i < o.count; ++i) {
        vec3 center = vec3(o.sphere[i].x, o.sphere[i].y, o.sphere[i].z);
        float share = length(position - center) / o.sphere[i].w;
        nearest = share < least ? i : nearest;
        least = min(least, share);
    }
    return nearest == o.own;
}

LUXEL_END
#endif
