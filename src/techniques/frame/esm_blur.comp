// SPDX-License-Identifier: MIT
// One direction of a Gaussian blur of exp(c z), stored as z so that no exponential overflows.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "techniques/frame/esm_params.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0, scalar) uniform params { EsmParams p; };
layout(binding = 1) uniform sampler2DArray from;
layout(binding = 2, r32f) uniform writeonly image2DArray to;

void main() {
    ivec3 texel = ivec3(gl_GlobalInvocationID);
    ivec2 size = textureSize(from, 0).xy;
    if (texel.x >= size.x || texel.y >= size.y || texel.z >= p.maps) return;

    LogSum sum = LogSum(-1e30, 0.0);
    float weights = 0.0;
    for (int i = -ESM_RADIUS; i <= ESM_RADIUS; ++i) {
        ivec2 q = clamp(texel.xy + p.direction * i, ivec2(0), size - 1);
        float z = texelFetch(from, ivec3(q, texel.z), 0).r;
        if (p.reversed != 0u) z = linear_light_depth(p.views[texel.z], z);
        sum = log_add(sum, p.exponent * z, esm_weight(i));
        weights += esm_weight(i);
    }
    imageStore(to, texel, vec4((sum.largest + log(sum.sum / weights)) / p.exponent));
}
