#version 460
#extension GL_EXT_scalar_block_layout : require
// SPDX-License-Identifier: MIT
// out[i] = a * i + b
layout(local_size_x = 64) in;
layout(scalar, binding = 0) uniform Params { uint count; vec3 unused; float a; float b; } params;
layout(scalar, binding = 1) writeonly buffer Values { float values[]; };
void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i < params.count) values[i] = params.a * float(i) + params.b;
}
