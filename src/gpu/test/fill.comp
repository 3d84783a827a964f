// SPDX-License-Identifier: MIT
// values[i] = a * i + b
#version 460
#extension GL_EXT_scalar_block_layout : require
layout(local_size_x = 64) in;
struct Line {
    vec3 unused; // scalar layout: a follows at once
    float a;
};
layout(scalar, binding = 0) uniform Params {
    uint count;
    Line line;
    mat3 rotation;
    float b;
}
params;
layout(scalar, binding = 1) writeonly buffer Values { float values[]; };
layout(scalar, binding = 2) readonly buffer Unused { float unused[]; };
void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i < params.count) values[i] = params.line.a * float(i) + params.b + params.rotation[2].z;
}
