// SPDX-License-Identifier: MIT
// The next level of the min-max pyramid.
#version 460
layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0) uniform sampler2D from;
layout(binding = 1, rg32f) uniform writeonly image2D to;

void main() {
    ivec2 cell = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(cell, imageSize(to)))) return;
    vec2 most = vec2(-1e30);
    for (int i = 0; i < 4; ++i)
        most = max(most, texelFetch(from, 2 * cell + ivec2(i & 1, i >> 1), 0).rg);
    imageStore(to, cell, vec4(most, 0, 0));
}
