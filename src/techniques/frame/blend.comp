// SPDX-License-Identifier: MIT
// Lays one layer of alpha-blended surfaces over the picture: its coverage of what it shows, the rest of what is behind.
#version 460

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0) uniform sampler2D base_depth; // 0: background
layout(binding = 1) uniform sampler2D layer_depth;
layout(binding = 2) uniform sampler2D layer_normal; // a = coverage
layout(binding = 3) uniform sampler2D layer_direct;
layout(binding = 4) uniform sampler2D layer_ambient;
layout(binding = 5, rgba32f) uniform image2D radiance;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(radiance)))) return;
    float behind = texelFetch(base_depth, pixel, 0).r, z = texelFetch(layer_depth, pixel, 0).r;
    if (z <= 0.0 || (behind > 0.0 && z > behind)) return;
    float coverage = texelFetch(layer_normal, pixel, 0).a;
    vec3 shown = texelFetch(layer_direct, pixel, 0).rgb + texelFetch(layer_ambient, pixel, 0).rgb;
    imageStore(radiance, pixel, vec4(mix(imageLoad(radiance, pixel).rgb, shown, coverage), 1));
}
