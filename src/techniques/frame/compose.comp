// SPDX-License-Identifier: MIT
// The frame before the techniques' contributions: direct light, ambient light times accessibility, and the
// environment where no surface is seen.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "techniques/frame/compose_params.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0, scalar) uniform params { ComposeParams p; };
layout(binding = 1) uniform sampler2D depth;
layout(binding = 2) uniform sampler2D direct;
layout(binding = 3) uniform sampler2D ambient;
layout(binding = 4) uniform sampler2D accessibility;
layout(binding = 5) uniform sampler2D environment;
layout(binding = 6, rgba32f) uniform writeonly image2D radiance;
#include "techniques/frame/sky.glsl"

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(radiance)))) return;
    vec3 sum = vec3(0);
    if (texelFetch(depth, pixel, 0).r > 0.0) {
        // 1x1 images stand for what the frame does not have.
        ivec2 a = min(pixel, textureSize(accessibility, 0) - 1), b = min(pixel, textureSize(ambient, 0) - 1);
        sum = texelFetch(direct, pixel, 0).rgb +
              texelFetch(accessibility, a, 0).r * texelFetch(ambient, b, 0).rgb;
    } else {
        vec3 direction = world_position(p.view, vec2(pixel) + 0.5, 1.0) - p.view.position;
        sum = sky_radiance(environment, direction, p.environment_rotation, p.environment_scale);
    }
    imageStore(radiance, pixel, vec4(sum, 1));
}
