// SPDX-License-Identifier: MIT
// Coarse irradiance to full size, times the full-size albedo: the technique's contribution to the frame.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "techniques/isr/compose_params.h"
#include "techniques/common/upsample.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0, scalar) uniform params { IsrComposeParams p; };
layout(binding = 1) uniform sampler2D irradiance;
layout(binding = 2) uniform sampler2D guide;
layout(binding = 3) uniform sampler2D depth;
layout(binding = 4) uniform sampler2D normal;
layout(binding = 5) uniform sampler2D diffuse;
layout(binding = 6) uniform sampler2D direct;
layout(binding = 7, rgba32f) uniform writeonly image2D radiance;
layout(binding = 8, r32f) uniform writeonly image2D accessibility;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    ivec2 size = textureSize(depth, 0);
    if (pixel.x >= size.x || pixel.y >= size.y) return;
    float z = texelFetch(depth, pixel, 0).r;
    vec4 e = vec4(0, 0, 0, 1);
    if (z > 0.0) {
        vec3 n = texelFetch(normal, pixel, 0).xyz;
        e = bilateral_upsample(irradiance, guide, vec2(pixel) + 0.5, p.scale, n, z);
    }
    vec3 l = texelFetch(diffuse, pixel, 0).rgb / PI * e.rgb;
    float open = e.a;
    if (p.mode == ISR_THESIS) {
        // [Rohleder2010, eq. 29] as a difference to plain direct light, which composition adds.
        float shade = clamp(e.a + 1.0 - p.k_ssao, 0.0, 1.0);
        l = p.k_isr * e.rgb + texelFetch(direct, pixel, 0).rgb * (shade - 1.0);
        open = 1.0; // the shading is already in
    }
    if (z <= 0.0) l = vec3(0);
    imageStore(radiance, pixel, vec4(l, 0));
    imageStore(accessibility, pixel, vec4(open));
}
