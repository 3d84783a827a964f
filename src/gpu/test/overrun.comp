// SPDX-License-Identifier: MIT
// Writes behind the end of a buffer: a deliberate fault.
#version 460
#extension GL_EXT_scalar_block_layout : require
layout(local_size_x = 1) in;
layout(scalar, binding = 0) uniform Params { uint place; } params;
layout(scalar, binding = 1) writeonly buffer Values { float values[]; };
void main() { values[params.place] = 1.0; }
