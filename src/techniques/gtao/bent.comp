// SPDX-License-Identifier: MIT
// Mean of the bent normals of a 4x4 block of estimated pixels at like depth, in world space.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "techniques/gtao/bent_params.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0, scalar) uniform params { GtaoBentParams p; };
layout(binding = 1) uniform sampler2D taps; // camera space, a = depth
layout(binding = 2) uniform sampler2D depth;
layout(binding = 3) uniform sampler2D normal;
layout(binding = 4, rgba16f) uniform writeonly image2D bent; // world space; a = 1 on a surface

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(bent)))) return;
    float z = texelFetch(depth, pixel, 0).r;
    ivec2 last = textureSize(taps, 0) - 1, at = pixel / p.step;
    vec3 sum = vec3(0);
    for (int i = 0; i < 16; ++i) {
        vec4 tap = texelFetch(taps, clamp(at + ivec2((i & 3) - 1, (i >> 2) - 1), ivec2(0), last), 0);
        if (tap.w > 0.0 && abs(tap.w - z) < p.limit * z) sum += tap.xyz;
    }
    vec3 world = sum.x * p.right + sum.y * p.up + sum.z * p.forward;
    if (dot(world, world) < 1e-12) world = texelFetch(normal, pixel, 0).xyz;
    imageStore(bent, pixel, z > 0.0 ? vec4(normalize(world), 1) : vec4(0));
}
