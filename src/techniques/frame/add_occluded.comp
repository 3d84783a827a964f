// SPDX-License-Identifier: MIT
// Adds the color of one image, times the accessibility of the occlusion slot, to another, whose alpha stays.
#version 460
layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0) uniform sampler2D contribution;
layout(binding = 1) uniform sampler2D accessibility;
layout(binding = 2, rgba32f) uniform image2D radiance;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(radiance)))) return;
    vec3 added = texelFetch(contribution, pixel, 0).rgb * texelFetch(accessibility, pixel, 0).r;
    imageStore(radiance, pixel, imageLoad(radiance, pixel) + vec4(added, 0));
}
