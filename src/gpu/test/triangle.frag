// SPDX-License-Identifier: MIT
#version 460
#extension GL_EXT_scalar_block_layout : require
layout(scalar, set = 0, binding = 0) uniform Params { vec4 color; } params;
layout(location = 0) out vec4 color;
void main() { color = params.color; }
