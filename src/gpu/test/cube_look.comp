// SPDX-License-Identifier: MIT
// Looks up a cube, filtered, in given directions.
#version 460
#extension GL_EXT_scalar_block_layout : require
layout(local_size_x = 64) in;
layout(scalar, binding = 0) readonly buffer Directions { vec4 direction[]; };
layout(binding = 1) uniform samplerCube cube;
layout(scalar, binding = 2) writeonly buffer Found { vec4 found[]; };
void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i < direction.length()) found[i] = textureLod(cube, direction[i].xyz, 0.0);
}
