// SPDX-License-Identifier: MIT
// The maps as numbers, and their first coarser level.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/vpl/ism_pull.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0) uniform usampler2D nearest;
layout(binding = 1, r32f) uniform writeonly image2D fine;
layout(binding = 2, r32f) uniform writeonly image2D coarse;

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(texel, imageSize(coarse)))) return;
    vec4 values;
    for (int k = 0; k < 4; ++k) {
        ivec2 part = 2 * texel + ivec2(k & 1, k >> 1);
        values[k] = uintBitsToFloat(texelFetch(nearest, part, 0).r);
        imageStore(fine, part, vec4(values[k]));
    }
    imageStore(coarse, texel, vec4(farthest_of_valid(values)));
}
