// SPDX-License-Identifier: MIT
// Reads the depth image that it is tested against.
#version 460
#extension GL_EXT_scalar_block_layout : require
layout(set = 0, binding = 0) uniform sampler2D depth;
layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 color;
void main() { color = vec4(textureLod(depth, uv, 0.0).x); }
