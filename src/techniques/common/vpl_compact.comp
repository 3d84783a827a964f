// SPDX-License-Identifier: MIT
// Keeps the candidates that send light, in their order: sums over the list do not depend on scheduling.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "techniques/common/vpl_params.h"

const int SIZE = 256;
layout(local_size_x = SIZE) in;
layout(binding = 0, scalar) uniform params { VplCompactParams p; };
layout(binding = 1, scalar) readonly buffer candidates { vec4 texel_of[]; };
layout(binding = 2, scalar) writeonly buffer lights { vec4 light_texel[]; };
layout(binding = 3, scalar) writeonly buffer light_count { int count; };

shared int sums[SIZE];

void main() {
    int lane = int(gl_LocalInvocationID.x), kept = 0;
    for (int start = 0; start < p.candidates; start += SIZE) {
        int from = (start + lane) * VPL_TEXELS;
        bool keep = start + lane < p.candidates;
        if (keep) keep = texel_of[from + 2].xyz != vec3(0);

        // Inclusive prefix sum, in log2(SIZE) steps.
        sums[lane] = keep ? 1 : 0;
        barrier();
        for (int step = 1; step < SIZE; step *= 2) {
            int before = lane >= step ? sums[lane - step] : 0;
            barrier();
            sums[lane] += before;
            barrier();
        }
        if (keep)
            for (int k = 0; k < VPL_TEXELS; ++k)
                light_texel[(kept + sums[lane] - 1) * VPL_TEXELS + k] = texel_of[from + k];
        kept += sums[SIZE - 1];
        barrier();
    }
    if (lane == 0) count = kept;
}
