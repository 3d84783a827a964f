// SPDX-License-Identifier: MIT
// Surfaces with an alpha test.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#define TEXTURES TEXTURES_ALL
#include "techniques/common/fragment_lists_fragment.glsl"
#include "techniques/frame/material.glsl"

layout(location = 5) in vec4 uv;
layout(location = 6) in float alpha;

void main() {
    ListFragment f = list_fragment();
    float texel = look_up_base_color(uv.xy, uv.zw).a;
    if (m.base_color.a * texel * alpha < m.alpha_cutoff) discard;
    append(f);
}
