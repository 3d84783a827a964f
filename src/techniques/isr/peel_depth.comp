// SPDX-License-Identifier: MIT
// Depth that a hidden patch must lie behind, for each visible one.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "techniques/isr/view_params.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0, scalar) uniform params { IsrPeelParams p; };
layout(binding = 1) uniform sampler2D patches;
layout(binding = 2, r32f) uniform writeonly image2D depth;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(depth)))) return;
    imageStore(depth, pixel, vec4(texelFetch(patches, pixel, 0).w * (1.0 + p.separation)));
}
