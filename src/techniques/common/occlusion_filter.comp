// SPDX-License-Identifier: MIT
// One direction of the 4x4 box filter that averages the turned taps of the pattern [Umenhoffer2009, 4.1.3]. Pixels
// whose depth is off the plane through this pixel by more than a limit are left out. Deviation: the thesis compares
// depths alone, which also drops neighbors on any plane seen at a slant.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "techniques/common/occlusion_params.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0, scalar) uniform params { OcclusionFilterParams p; };
layout(binding = 1) uniform sampler2D from;         // r = accessibility, g = 1 / depth
layout(binding = 2) uniform writeonly image2D to;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    ivec2 last = textureSize(from, 0) - 1;
    if (any(greaterThan(pixel, last))) return;
    vec2 tap[4];
    for (int i = 0; i < 4; ++i) tap[i] = texelFetch(from, clamp(pixel + p.direction * (i - 1), ivec2(0), last), 0).rg;

    // 1/z is linear on a plane: its slope is that toward the neighbor that is closer in depth.
    vec2 here = tap[1];
    float back = here.g - tap[0].g, ahead = tap[2].g - here.g;
    float slope = abs(back) < abs(ahead) ? back : ahead;
    float tolerance = p.limit * here.g * here.g;
    float sum = here.r, count = 1.0;
    for (int i = 0; i < 4; ++i) {
        if (i == 1) continue;
        bool near = abs(tap[i].g - here.g - slope * float(i - 1)) < tolerance;
        sum += near ? tap[i].r : 0.0;
        count += near ? 1.0 : 0.0;
    }
    imageStore(to, pixel, vec4(sum / count, here.g, 0, 0));
}
