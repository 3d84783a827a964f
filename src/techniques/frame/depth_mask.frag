// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#define TEXTURES TEXTURES_ALL
#include "techniques/frame/material.glsl"

layout(location = 0) in vec4 uv;
layout(location = 1) in float alpha;

void main() {
    float texel = look_up(base_color_texture, m.base_color_texture, uv.xy, uv.zw).a;
    if (m.base_color.a * texel * alpha < m.alpha_cutoff) discard;
}
