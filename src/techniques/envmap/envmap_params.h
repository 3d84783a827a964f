// SPDX-License-Identifier: MIT
// Diffuse environment mapping: what C++ and the shaders share.
#ifndef LUXEL_ENVMAP_PARAMS_H
#define LUXEL_ENVMAP_PARAMS_H
#include "techniques/frame/view_params.h"
LUXEL_BEGIN

// Elements of the list of senders, in vec4: the quads' corners and radiance, or center, area and radiance.
LUXEL_CONST int ENVMAP_QUAD = 4;
LUXEL_CONST int ENVMAP_POINT = 3;
// Of the convolved map, and of the level that it is made of, a side of a face.
LUXEL_CONST int ENVMAP_CONVOLVED = 16;

// Prefiltered radiance: a side of the first level's faces; of level l, for roughness l / (levels - 1), half
// as many for each.
LUXEL_CONST int ENVMAP_GLOSSY = 128;
LUXEL_CONST int ENVMAP_GLOSSY_LEVELS = 5;
LUXEL_CONST uint ENVMAP_PREFILTER_SAMPLES = 128u;
LUXEL_CONST int ENVMAP_REFLECTANCE = 32; // a side of the table

struct EnvmapPrefilterParams {
    int size; // texels a side of the probe's cube
    float roughness;
};

// From a probe's cube to its list of senders, or to its convolved map.
struct EnvmapListParams {
    vec3 center; // of the probe, world
    int probe;
    int texels;           // M
    float level;          // of the cube, where a face has M texels
    float distance_level; // of the cube, that corners' distances are read from
    float corners;        // 1: the mean of the corners' radiances, 0: the texel's
};

struct EnvmapGatherParams {
    ViewParams view;
    int senders;     // of each probe
    int probe;       // of the object
    ivec3 grid;      // probes along each axis, probes=grid
    vec3 grid_least; // world position of the first
    vec3 grid_step;  // meters between neighbors; 1 where an axis has only one
};

// Corner k (bits: x, y, z) of the cell of the grid that a point lies in, and its trilinear weight.
struct EnvmapNeighbor {
    int probe;
    float weight;
};
LUXEL_FN EnvmapNeighbor envmap_neighbor(EnvmapGatherParams p, vec3 position, int k) {
    EnvmapNeighbor r;
    r.weight = 1.0f;
    int index[3];
    for (int i = 0; i < 3; ++i) {
        float most = float(p.grid[i] - 1);
        float x = clamp((position[i] - p.grid_least[i]) / p.grid_step[i], 0.0f, most);
        float low = min(floor(x), max(most - 1.0f, 0.0f));
        bool upper = ((k >> i) & 1) != 0;
        index[i] = min(int(low) + (upper ? 1 : 0), p.grid[i] - 1);
        r.weight *= upper ? x - low : 1.0f - (x - low);
    }
    r.probe = (index[2] * p.grid[1] + index[1]) * p.grid[0] + index[0];
    return r;
}

// World position of a probe of the grid.
LUXEL_FN vec3 envmap_position(EnvmapGatherParams p, int probe) {
    vec3 index = vec3(float(probe % p.grid[0]), float((probe / p.grid[0]) % p.grid[1]),
                      float(probe / (p.grid[0] * p.grid[1])));
    return p.grid_least + p.grid_step * index;
}

LUXEL_END
#endif
