// SPDX-License-Identifier: MIT
// Every other pixel of the G-buffer: depth for taps, normal and depth for receivers and for upsampling. Picked,
// not averaged, so that a pixel's ray and depth stay those of a surface.
#version 460
#extension GL_GOOGLE_include_directive : require

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0) uniform sampler2D depth;
layout(binding = 1) uniform sampler2D normal;
layout(binding = 2, r32f) uniform writeonly image2D small_depth;
layout(binding = 3, rgba32f) uniform writeonly image2D guide;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(small_depth)))) return;
    float z = texelFetch(depth, 2 * pixel, 0).r;
    imageStore(small_depth, pixel, vec4(z));
    imageStore(guide, pixel, vec4(texelFetch(normal, 2 * pixel, 0).xyz, z));
}
