// SPDX-License-Identifier: MIT
// Nearest and farthest distance of each layer of a distance cube, from the coarsest level of its pyramid.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "techniques/common/cube_trace_params.h"

layout(local_size_x = 8) in;
layout(binding = 0, scalar) uniform params { CubeRangeParams p; };
layout(binding = 1) uniform sampler2DArray coarsest;
layout(binding = 2, rg32f) uniform writeonly image2D ranges;

void main() {
    int layer = int(gl_GlobalInvocationID.x);
    if (layer >= p.layers) return;
    vec2 range = vec2(1e30, 0.0);
    for (int face = 0; face < 6; ++face) {
        vec2 d = texelFetch(coarsest, ivec3(0, 0, layer * 6 + face), 0).rg;
        range = vec2(min(range.x, d.x), max(range.y, d.y));
    }
    // A texel without a surface is at no distance at all.
    range.y = min(range.y, layer < p.near_layers ? p.near_most : p.far_most);
    imageStore(ranges, ivec2(layer, 0), vec4(range, 0, 0));
}
