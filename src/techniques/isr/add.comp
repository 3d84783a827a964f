// SPDX-License-Identifier: MIT
// Sum of two bounces; the accessibility in alpha is the first one's.
#version 460
layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0) uniform sampler2D a;
layout(binding = 1) uniform sampler2D b;
layout(binding = 2, rgba32f) uniform writeonly image2D sum;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    ivec2 size = textureSize(a, 0);
    if (pixel.x >= size.x || pixel.y >= size.y) return;
    vec4 x = texelFetch(a, pixel, 0);
    imageStore(sum, pixel, vec4(x.rgb + texelFetch(b, pixel, 0).rgb, x.a));
}
