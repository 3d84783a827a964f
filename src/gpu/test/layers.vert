// SPDX-License-Identifier: MIT
// Covers the layer of its instance with the instance's number.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_ARB_shader_viewport_layer_array : require
layout(location = 0) flat out float number;
void main() {
    vec2 uv = vec2(gl_VertexIndex == 1 ? 2.0 : 0.0, gl_VertexIndex == 2 ? 2.0 : 0.0);
    gl_Position = vec4(2.0 * uv - 1.0, 0.5, 1.0);
    gl_Layer = gl_InstanceIndex;
    number = float(gl_InstanceIndex + 1);
}
