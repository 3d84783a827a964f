// SPDX-License-Identifier: MIT
// Gathered irradiance to full size, times the albedo. Composition adds accessibility x ambient; the radiance
// here brings that to what the directions say: ambient less what the occluders hide of the environment.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "techniques/ssdo/compose_params.h"
#include "techniques/common/upsample.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0, scalar) uniform params { SsdoComposeParams p; };
layout(binding = 1) uniform sampler2D irradiance;
layout(binding = 2) uniform sampler2D receiver;
layout(binding = 3) uniform sampler2D depth;
layout(binding = 4) uniform sampler2D normal;
layout(binding = 5) uniform sampler2D diffuse;
layout(binding = 6) uniform sampler2D ambient;
layout(binding = 7, rgba32f) uniform writeonly image2D radiance;
layout(binding = 8, r32f) uniform writeonly image2D accessibility;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    ivec2 size = textureSize(depth, 0);
    if (pixel.x >= size.x || pixel.y >= size.y) return;
    float z = texelFetch(depth, pixel, 0).r;
    vec3 l = vec3(0);
    float open = 1.0;
    if (z > 0.0) {
        vec3 n = texelFetch(normal, pixel, 0).xyz;
        vec4 e = bilateral_upsample(irradiance, receiver, vec2(pixel) + 0.5, p.scale, n, z);
        vec3 unoccluded = texelFetch(ambient, pixel, 0).rgb;
        open = e.a;
        l = max(unoccluded + texelFetch(diffuse, pixel, 0).rgb / PI * e.rgb, vec3(0)) - open * unoccluded;
    }
    imageStore(radiance, pixel, vec4(l, 0));
    imageStore(accessibility, pixel, vec4(open));
}
