// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#define TEXTURES TEXTURES_ALL
#include "techniques/frame/material.glsl"

layout(location = 0) in vec4 uv;
layout(location = 1) in float alpha;

// Blended surfaces hold back their share of the light: they are drawn where their coverage exceeds this. Any 3x3
// texels have all nine levels of the inner pattern once, which is what the percentage-closer filter's box covers
// with equal weights wherever it lies; the outer pattern has nine steps between two levels.
float threshold_at(ivec2 texel) {
    const float rank[9] = float[](0.0, 7.0, 3.0, 6.0, 5.0, 2.0, 4.0, 1.0, 8.0);
    ivec2 inner = texel % 3, outer = (texel / 3) % 3;
    return (rank[inner.y * 3 + inner.x] + (rank[outer.y * 3 + outer.x] + 0.5) / 9.0) / 9.0;
}

void main() {
    float texel = look_up_base_color(uv.xy, uv.zw).a;
    float coverage = m.base_color.a * texel * alpha;
    if (coverage < mix(m.alpha_cutoff, threshold_at(ivec2(gl_FragCoord.xy)), m.blended)) discard;
}
