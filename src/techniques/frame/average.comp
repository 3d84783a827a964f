// SPDX-License-Identifier: MIT
// The mean of the samples of each pixel: squares of `from`, which is a multiple of `to` in size.
#version 460
layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0) uniform sampler2D from;
layout(binding = 1) uniform writeonly image2D to;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(to)))) return;
    int side = textureSize(from, 0).x / imageSize(to).x;
    vec4 sum = vec4(0);
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) sum += texelFetch(from, pixel * side + ivec2(x, y), 0);
    imageStore(to, pixel, sum / float(side * side));
}
