// SPDX-License-Identifier: MIT
// Fills holes from the next coarser level [Ritschel2008].
#version 460

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0) uniform sampler2D coarse;
layout(binding = 1, r32f) uniform image2D fine;

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(texel, imageSize(fine)))) return;
    if (imageLoad(fine, texel).r > 0.0) return;
    imageStore(fine, texel, texelFetch(coarse, texel >> 1, 0));
}
