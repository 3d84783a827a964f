// SPDX-License-Identifier: MIT
// Puts a peeled layer at the heads of the pixels' lists.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "techniques/common/fragment_lists_params.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0, scalar) uniform params { ListLayerParams p; };
layout(binding = 1) uniform usampler2D node;
layout(binding = 2) uniform usampler2D shading_normal;
layout(binding = 3) uniform sampler2D range;
layout(binding = 4) uniform sampler2D layer_depth;
layout(binding = 5, scalar) buffer heads { uint head_of[]; };
layout(binding = 6, scalar) writeonly buffer nodes { uvec4 node_of[]; };
layout(binding = 7, scalar) writeonly buffer shading { uint shading_of[]; };
layout(binding = 9, rg32f) uniform image2D min_max;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, ivec2(p.side))) || texelFetch(layer_depth, pixel, 0).r <= 0.0) return;
    uint place = uint(pixel.y) * uint(p.side) + uint(pixel.x), index = uint(p.layer * p.side * p.side) + place + 1u;
    uvec4 found = texelFetch(node, pixel, 0);
    found[LIST_NEXT] = head_of[place];
    head_of[place] = index;
    node_of[index] = found;
    shading_of[index] = texelFetch(shading_normal, pixel, 0).r;
    imageStore(min_max, pixel, vec4(max(imageLoad(min_max, pixel).rg, texelFetch(range, pixel, 0).rg), 0, 0));
}
