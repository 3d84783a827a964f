// SPDX-License-Identifier: MIT
// Compares with a depth image in its middle.
#version 460
#extension GL_EXT_scalar_block_layout : require
layout(local_size_x = 2) in;
layout(binding = 0) uniform sampler2DShadow shadow;
layout(scalar, binding = 1) writeonly buffer Found { float found[2]; };
void main() {
    uint i = gl_LocalInvocationID.x;
    found[i] = textureLod(shadow, vec3(0.5, 0.5, i == 0u ? 0.2 : 0.4), 0.0);
}
