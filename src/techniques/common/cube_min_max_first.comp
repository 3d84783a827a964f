// SPDX-License-Identifier: MIT
// The finest level of a pyramid of nearest and farthest distances.
#version 460
layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0) uniform sampler2DArray from;
layout(binding = 1, rg32f) uniform writeonly image2DArray to;

void main() {
    ivec3 texel = ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(texel.xy, imageSize(to).xy))) return;
    imageStore(to, texel, texelFetch(from, texel, 0).rrrr);
}
