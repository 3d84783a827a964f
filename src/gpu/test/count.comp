// SPDX-License-Identifier: MIT
// One for every invocation.
#version 460
#extension GL_EXT_scalar_block_layout : require
layout(local_size_x = 64) in;
layout(scalar, binding = 0) buffer Count { uint count; };
void main() { atomicAdd(count, 1u); }
