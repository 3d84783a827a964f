// SPDX-License-Identifier: MIT
// Irradiance of every coarse pixel from the patches of an additional camera. They may lie anywhere around the
// receiver: the taps cover the camera's whole image evenly.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "techniques/isr/view_params.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0, scalar) uniform params { IsrCameraParams p; };
layout(binding = 1) uniform sampler2D patches;
layout(binding = 2) uniform sampler2D source;
layout(binding = 3) uniform sampler2D receiver;
layout(binding = 4, rgba32f) uniform writeonly image2D irradiance;

void main() {
    ivec2 coarse = ivec2(gl_GlobalInvocationID.xy);
    if (coarse.x >= int(p.width) || coarse.y >= int(p.height)) return;
    vec4 at = texelFetch(receiver, coarse, 0);
    vec3 e = vec3(0);
    if (at.w > 0.0) {
        vec3 x_p = world_position(p.view, (vec2(coarse) + 0.5) * p.scale, at.w);
        vec2 size = vec2(p.camera.width, p.camera.height);
        float share = size.x * size.y / float(p.taps);
        IsrJitter jitter = isr_jitter(vec2(coarse));
        float turn = fract(jitter.turn + p.turn), shift = fract(jitter.shift + p.shift);
        for (int i = 0; i < p.taps; ++i) {
            ivec2 q = min(ivec2(isr_even_point(i, turn, shift) * size), ivec2(size) - 1);
            vec4 x = texelFetch(patches, q, 0);
            vec3 to_patch = world_position(p.camera, vec2(q) + 0.5, x.w) - x_p;
            e += shared_solid_angle(at.xyz, to_patch, x.xyz, share) * texelFetch(source, q, 0).rgb;
        }
    }
    imageStore(irradiance, coarse, vec4(e, 1.0));
}
