// SPDX-License-Identifier: MIT
// Range of depth and geometric normal in each 2x2 pixels.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/vpl/range.glsl"
layout(binding = 4) uniform sampler2D depth;
layout(binding = 5) uniform sampler2D geometric_normal;

void main() {
    ivec2 cell = ivec2(gl_GlobalInvocationID.xy), size = textureSize(depth, 0);
    if (any(greaterThanEqual(cell, imageSize(least)))) return;
    vec4 low = vec4(1e30), high = vec4(-1e30);
    for (int k = 0; k < 4; ++k) {
        ivec2 pixel = 2 * cell + ivec2(k & 1, k >> 1);
        bool inside = all(lessThan(pixel, size));
        vec4 v = vec4(0);
        if (inside) v = vec4(texelFetch(geometric_normal, pixel, 0).xyz, texelFetch(depth, pixel, 0).r);
        low = min(low, v), high = max(high, v);
    }
    store_range(cell, low, high);
}
