// SPDX-License-Identifier: MIT
// Covers everything at one depth; there is no fragment shader.
#version 460
#extension GL_EXT_scalar_block_layout : require
layout(scalar, set = 0, binding = 0) uniform Params { float depth; } params;
void main() {
    vec2 uv = vec2(gl_VertexIndex == 1 ? 2.0 : 0.0, gl_VertexIndex == 2 ? 2.0 : 0.0);
    gl_Position = vec4(2.0 * uv - 1.0, params.depth, 1.0);
}
