// SPDX-License-Identifier: MIT
// Sums of four cells, and how many cells of this level hold anything [Le2014, figure 3.5].
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "techniques/photon_map/photon_map_params.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0, scalar) uniform params { PhotonFluxParams p; };
layout(binding = 1) uniform sampler2D from;
layout(binding = 2, rgba32f) uniform writeonly image2D sums;
layout(binding = 3, scalar) buffer counts { uint count_of[]; };

void main() {
    ivec2 cell = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(cell, imageSize(sums)))) return;
    vec4 sum = vec4(0);
    for (int i = 0; i < 4; ++i) sum += texelFetch(from, 2 * cell + ivec2(i & 1, i >> 1), 0);
    imageStore(sums, cell, sum);
    if (sum.a > 0.0) atomicAdd(count_of[PHOTON_LEVELS + p.level], 1u);
}
