// SPDX-License-Identifier: MIT
// The next coarser level of imperfect shadow maps.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/vpl/ism_pull.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0) uniform sampler2D fine;
layout(binding = 1, r32f) uniform writeonly image2D coarse;

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(texel, imageSize(coarse)))) return;
    vec4 values;
    for (int k = 0; k < 4; ++k) values[k] = texelFetch(fine, 2 * texel + ivec2(k & 1, k >> 1), 0).r;
    imageStore(coarse, texel, vec4(farthest_of_valid(values)));
}
