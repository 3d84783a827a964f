// SPDX-License-Identifier: MIT
// A triangle that covers everything, at the depth of its instance.
#version 460
#extension GL_EXT_scalar_block_layout : require
layout(location = 0) out vec2 uv;
void main() {
    uv = vec2(gl_VertexIndex == 1 ? 2.0 : 0.0, gl_VertexIndex == 2 ? 2.0 : 0.0);
    gl_Position = vec4(2.0 * uv - 1.0, 0.25 * float(gl_InstanceIndex), 1.0);
}
