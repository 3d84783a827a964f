// SPDX-License-Identifier: MIT
// Clears a contribution where the frame shows objects that another technique of its slot lights.
#version 460
#extension GL_GOOGLE_include_directive : require
layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0) uniform sampler2D hardware_depth;
layout(binding = 1) uniform sampler2D object_depth;
layout(binding = 2, rgba32f) uniform image2D radiance;
#include "techniques/frame/object_depth.glsl"

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(radiance)))) return;
    float depth = texelFetch(hardware_depth, pixel, 0).r;
    if (depth > 0.0 && shows_object(texelFetch(object_depth, pixel, 0).r, depth))
        imageStore(radiance, pixel, vec4(0));
}
