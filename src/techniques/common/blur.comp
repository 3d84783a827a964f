// SPDX-License-Identifier: MIT
// One direction of a separable Gaussian blur. `guide` holds the normal in rgb and linear depth in a (0 = nothing).
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "techniques/common/blur_params.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0, scalar) uniform params { BlurParams p; };
layout(binding = 1) uniform sampler2D guide;
layout(binding = 2) uniform sampler2D from;
layout(binding = 3, rgba32f) uniform writeonly image2D to;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    ivec2 size = textureSize(from, 0);
    if (pixel.x >= size.x || pixel.y >= size.y) return;
    vec4 here = texelFetch(guide, pixel, 0);
    vec4 sum = texelFetch(from, pixel, 0);
    float weights = 1.0;
    for (int i = -p.radius; i <= p.radius; ++i) {
        ivec2 q = pixel + p.direction * i;
        if (i == 0 || q.x < 0 || q.y < 0 || q.x >= size.x || q.y >= size.y) continue;
        float w = exp(-0.5 * float(i * i) / (p.sigma * p.sigma));
        if (p.depth_tolerance > 0.0) {
            vec4 there = texelFetch(guide, q, 0);
            if (there.w <= 0.0) continue;
            float dz = abs(there.w - here.w) / max(here.w, 1e-6);
            w *= edge_weight(dz, abs(float(i)), dot(here.xyz, there.xyz), p.depth_tolerance);
        }
        sum += w * texelFetch(from, q, 0);
        weights += w;
    }
    imageStore(to, pixel, sum / weights);
}
