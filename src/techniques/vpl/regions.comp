// SPDX-License-Identifier: MIT
// Lists the valid regions of one level: not divided, in a parent that is [Le2014, alg. 3.1].
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "techniques/vpl/vpl_params.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0, scalar) uniform params { VplRegionParams p; };
layout(binding = 1) uniform sampler2D depth;
layout(binding = 2) uniform sampler2D divided; // all mips; mip m is level m + 1
layout(binding = 3, scalar) writeonly buffer regions { uint region[]; };
layout(binding = 4, scalar) buffer region_counts { int region_count[]; };

shared int in_group, first;

bool is_valid(ivec2 cell) {
    ivec2 pixel = cell << p.level;
    if (any(greaterThanEqual(pixel, textureSize(depth, 0)))) return false;
    if (texelFetch(depth, pixel, 0).r <= 0.0) return false;
    if (p.level > 0 && texelFetch(divided, cell, p.level - 1).r > 0.0) return false;
    return p.level == p.coarsest || texelFetch(divided, cell >> 1, p.level).r > 0.0;
}

void main() {
    if (gl_LocalInvocationIndex == 0) in_group = 0;
    barrier();
    ivec2 cell = ivec2(gl_GlobalInvocationID.xy);
    bool valid = is_valid(cell);
    int place = valid ? atomicAdd(in_group, 1) : 0;
    barrier();
    if (gl_LocalInvocationIndex == 0) first = atomicAdd(region_count[p.level], in_group);
    barrier();
    if (valid) region[first + place] = uint(cell.x) | uint(cell.y) << 16u;
}
