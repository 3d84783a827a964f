// SPDX-License-Identifier: MIT
// A bounce's irradiance becomes the next bounce's source: albedo/pi E.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "techniques/isr/isr_params.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0, scalar) uniform params { IsrReflectParams p; };
layout(binding = 1) uniform sampler2D irradiance;
layout(binding = 2) uniform sampler2D albedo;
layout(binding = 3, rgba32f) uniform writeonly image2D source;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    ivec2 size = textureSize(irradiance, 0);
    if (pixel.x >= size.x || pixel.y >= size.y) return;
    vec3 e = texelFetch(irradiance, pixel, 0).rgb;
    imageStore(source, pixel + p.origin, vec4(texelFetch(albedo, pixel, 0).rgb * e / PI, 1.0));
}
