// SPDX-License-Identifier: MIT
// sum[i] += term[i]
#version 460
#extension GL_EXT_scalar_block_layout : require
layout(local_size_x = 64) in;
layout(scalar, binding = 0) readonly buffer Term { float term[]; };
layout(scalar, binding = 1) buffer Sum { float sum[]; };
void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i < term.length()) sum[i] += term[i];
}
