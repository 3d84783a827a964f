// SPDX-License-Identifier: MIT
// Positions pulled from a buffer.
#version 460
#extension GL_EXT_scalar_block_layout : require
layout(scalar, set = 0, binding = 0) uniform Params { vec4 color; } params;
layout(scalar, set = 0, binding = 1) readonly buffer Vertices { vec3 vertices[]; };
void main() { gl_Position = vec4(vertices[gl_VertexIndex], 1.0); }
