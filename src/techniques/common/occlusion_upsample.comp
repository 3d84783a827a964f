// SPDX-License-Identifier: MIT
// Half-size accessibility to full size.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "techniques/common/occlusion_params.h"
#include "techniques/common/upsample.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0, scalar) uniform params { OcclusionUpsampleParams p; };
layout(binding = 1) uniform sampler2D from;
layout(binding = 2) uniform sampler2D guide;
layout(binding = 3) uniform sampler2D depth;
layout(binding = 4) uniform sampler2D normal;
layout(binding = 5, r32f) uniform writeonly image2D accessibility;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, p.size))) return;
    float z = texelFetch(depth, pixel, 0).r;
    vec3 n = texelFetch(normal, pixel, 0).xyz;

    // Small pixels were picked at the upper left of their blocks: half a frame pixel from where the function
    // expects their centers.
    vec2 at = vec2(pixel) + 0.5 * p.step;
    vec2 found = z > 0.0 ? bilateral_upsample(from, guide, at, p.step, n, z).rg : vec2(0);
    imageStore(accessibility, pixel, vec4(found.g > 0.0 ? found.r : 1.0)); // g = 1 / depth: 0 = no neighbor
}
