// SPDX-License-Identifier: MIT
// Draws lights among the candidates by importance: systematic sampling, so that what is drawn several times is one
// light. Fluxes and areas are divided by how many were to be expected. One work group; the order is kept.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "techniques/vpl/importance_params.h"

const int SIZE = int(VPL_RESAMPLE_LANES);
layout(local_size_x = VPL_RESAMPLE_LANES) in;
layout(binding = 0, scalar) uniform params { VplResampleParams p; };
layout(binding = 1) uniform samplerBuffer candidates;
layout(binding = 2, scalar) readonly buffer candidate_count { int candidate_total; };
layout(binding = 3, scalar) readonly buffer importances { vec2 importance_of[]; };
layout(binding = 4, scalar) writeonly buffer lights { vec4 light_texel[]; };
layout(binding = 5, scalar) writeonly buffer light_count { int count; };

shared vec2 sums[SIZE];

// Inclusive prefix sums over the lanes, in log2(SIZE) steps.
void scan(int lane, vec2 value) {
    sums[lane] = value;
    barrier();
    for (int step = 1; step < SIZE; step *= 2) {
        vec2 before = lane >= step ? sums[lane - step] : vec2(0);
        barrier();
        sums[lane] += before;
        barrier();
    }
}

void main() {
    int lane = int(gl_LocalInvocationID.x);
    vec2 own = vec2(0);
    for (int i = lane; i < candidate_total; i += SIZE) own += importance_of[i];
    scan(lane, own);
    vec2 total = sums[SIZE - 1];
    barrier();
    float by_flux = total.x > 0.0 ? p.by_flux : 1.0;
    vec2 scale = vec2(total.x > 0.0 ? (1.0 - by_flux) / total.x : 0.0, total.y > 0.0 ? by_flux / total.y : 0.0);

    float covered = 0.0;
    int kept = 0;
    for (int start = 0; start < candidate_total; start += SIZE) {
        int i = start + lane;
        float chance = i < candidate_total ? dot(scale, importance_of[i]) : 0.0;
        scan(lane, vec2(chance, 0.0));
        float from = covered + (lane > 0 ? sums[lane - 1].x : 0.0), to = covered + sums[lane].x;
        covered += sums[SIZE - 1].x;
        barrier();
        int times = total.y > 0.0 ? times_drawn(from, to, p.wanted) : 0;
        scan(lane, vec2(times > 0 ? 1.0 : 0.0, 0.0));
        if (times > 0) {
            float share = float(times) / (float(p.wanted) * chance);
            int at = (kept + int(sums[lane].x) - 1) * VPL_TEXELS, of = i * VPL_TEXELS;
            vec4 position = texelFetch(candidates, of), flux = texelFetch(candidates, of + 2);
            light_texel[at] = vec4(position.xyz, position.w * share);
            light_texel[at + 1] = texelFetch(candidates, of + 1);
            light_texel[at + 2] = vec4(flux.rgb * share, 0);
        }
        kept += int(sums[SIZE - 1].x);
        barrier();
    }
    if (lane == 0) count = kept;
}
