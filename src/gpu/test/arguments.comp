// SPDX-License-Identifier: MIT
// Group counts for an indirect dispatch, after one word of something else.
#version 460
#extension GL_EXT_scalar_block_layout : require
layout(local_size_x = 1) in;
layout(scalar, binding = 0) uniform Params { uint groups; } params;
layout(scalar, binding = 1) writeonly buffer Arguments { uint arguments[]; };
void main() {
    arguments[1] = params.groups;
    arguments[2] = 1u;
    arguments[3] = 1u;
}
