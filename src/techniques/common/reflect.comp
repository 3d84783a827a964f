// SPDX-License-Identifier: MIT
// Radiance that the Lambertian lobe makes of irradiance.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0) uniform sampler2D irradiance;
layout(binding = 1) uniform sampler2D diffuse;
layout(binding = 2, rgba32f) uniform writeonly image2D radiance;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(radiance)))) return;
    vec3 e = texelFetch(irradiance, pixel, 0).rgb;
    imageStore(radiance, pixel, vec4(e * texelFetch(diffuse, pixel, 0).rgb / PI, 1));
}
