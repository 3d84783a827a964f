// SPDX-License-Identifier: MIT
// Unoccluded environment light off the diffuse lobe.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "techniques/frame/ambient_params.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0, scalar) uniform params { AmbientParams p; };
layout(binding = 1) uniform sampler2D diffuse;
layout(binding = 2) uniform sampler2D normal;
layout(binding = 3, rgba32f) uniform writeonly image2D ambient;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(ambient)))) return;
    vec4 n = texelFetch(normal, pixel, 0);
    vec3 radiance = vec3(0);
    if (n.a > 0.0) radiance = texelFetch(diffuse, pixel, 0).rgb / PI * sh_irradiance(p, normalize(n.xyz));
    imageStore(ambient, pixel, vec4(radiance, 1));
}
