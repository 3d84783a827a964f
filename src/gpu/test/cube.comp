// SPDX-License-Identifier: MIT
// Looks along the six axes.
#version 460
#extension GL_EXT_scalar_block_layout : require
layout(local_size_x = 6) in;
layout(binding = 0) uniform samplerCube cube;
layout(scalar, binding = 1) writeonly buffer Found { vec4 found[6]; };
void main() {
    uint face = gl_LocalInvocationID.x;
    vec3 d = vec3(0.0);
    d[face / 2u] = face % 2u == 0u ? 1.0 : -1.0;
    found[face] = textureLod(cube, d, 0.0);
}
