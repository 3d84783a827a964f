// SPDX-License-Identifier: MIT
// A level of a pyramid of nearest and farthest distances from the finer one.
#version 460
layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0) uniform sampler2DArray from;
layout(binding = 1, rg32f) uniform writeonly image2DArray to;

void main() {
    ivec3 texel = ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(texel.xy, imageSize(to).xy))) return;
    vec2 found = vec2(1e30, -1e30);
    for (int i = 0; i < 4; ++i) {
        vec2 d = texelFetch(from, ivec3(texel.xy * 2 + ivec2(i & 1, i >> 1), texel.z), 0).rg;
        found = vec2(min(found.x, d.x), max(found.y, d.y));
    }
    imageStore(to, texel, found.xyxy);
}
