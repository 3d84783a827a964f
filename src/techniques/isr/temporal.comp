// SPDX-License-Identifier: MIT
// Mean of this frame's irradiance and of what earlier frames found on the same surface.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "techniques/isr/view_params.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0, scalar) uniform params { IsrTemporalParams p; };
layout(binding = 1) uniform sampler2D irradiance;
layout(binding = 2) uniform sampler2D guide; // normal, depth
layout(binding = 3) uniform sampler2D history;
layout(binding = 4) uniform sampler2D history_guide;
layout(binding = 5) uniform sampler2D history_length; // frames
layout(binding = 6, rgba32f) uniform writeonly image2D mean;
layout(binding = 7, r32f) uniform writeonly image2D mean_length;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    ivec2 size = textureSize(irradiance, 0);
    if (pixel.x >= size.x || pixel.y >= size.y) return;
    vec4 now = texelFetch(irradiance, pixel, 0), here = texelFetch(guide, pixel, 0);
    vec3 position = world_position(p.view, (vec2(pixel) + 0.5) * p.scale, here.w);
    IsrProjection earlier = isr_project(p.before, position);

    // Bilinear weights of the pixels that saw the same plane.
    vec2 at = earlier.pixel / p.scale - 0.5;
    ivec2 base = ivec2(floor(at));
    vec2 f = at - vec2(base);
    vec4 sum = vec4(0);
    float frames = 0.0, weights = 0.0;
    for (int i = 0; i < 4; ++i) {
        ivec2 o = ivec2(i & 1, i >> 1), q = base + o;
        if (q.x < 0 || q.y < 0 || q.x >= size.x || q.y >= size.y) continue;
        vec4 there = texelFetch(history_guide, q, 0);
        vec3 x = world_position(p.before, (vec2(q) + 0.5) * p.scale, there.w);
        bool same = there.w > 0.0 && dot(there.xyz, here.xyz) >= p.least_cos &&
                    abs(dot(x - position, here.xyz)) <= p.tolerance * here.w;
        float w = same ? (o.x == 1 ? f.x : 1.0 - f.x) * (o.y == 1 ? f.y : 1.0 - f.y) : 0.0;
        sum += w * texelFetch(history, q, 0);
        frames += w * texelFetch(history_length, q, 0).r;
        weights += w;
    }

    // A mean over frames until the history is full, an exponential one after that.
    bool found = here.w > 0.0 && earlier.depth > 0.0 && weights > 1e-3;
    float length = found ? min(frames / weights + 1.0, p.frames) : 1.0;
    vec4 result = found ? mix(sum / weights, now, 1.0 / length) : now;
    imageStore(mean, pixel, result);
    imageStore(mean_length, pixel, vec4(length));
}
