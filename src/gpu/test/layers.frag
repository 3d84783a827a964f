// SPDX-License-Identifier: MIT
#version 460
#extension GL_EXT_scalar_block_layout : require
layout(location = 0) flat in float number;
layout(location = 0) out vec4 color;
void main() { color = vec4(number); }
