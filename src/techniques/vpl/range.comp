// SPDX-License-Identifier: MIT
// Range of the next coarser level.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/vpl/range.glsl"
layout(binding = 4) uniform sampler2D from_least;
layout(binding = 5) uniform sampler2D from_most;

void main() {
    ivec2 cell = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(cell, imageSize(least)))) return;
    vec4 low = vec4(1e30), high = vec4(-1e30);
    for (int k = 0; k < 4; ++k) {
        ivec2 child = 2 * cell + ivec2(k & 1, k >> 1);
        low = min(low, texelFetch(from_least, child, 0)), high = max(high, texelFetch(from_most, child, 0));
    }
    store_range(cell, low, high);
}
