// SPDX-License-Identifier: MIT
// The ways to read a table: float4, uint and int texels, and a uniform block.
#version 460
#extension GL_EXT_scalar_block_layout : require
layout(local_size_x = 1) in;
layout(binding = 0) uniform samplerBuffer colors;
layout(binding = 1) uniform usamplerBuffer counts;
layout(binding = 2) uniform isamplerBuffer offsets;
layout(scalar, binding = 3) uniform Weights { float weights[4]; };
layout(scalar, binding = 4) writeonly buffer Found { vec4 found[]; };
void main() {
    uint i = gl_GlobalInvocationID.x;
    found[i] = texelFetch(colors, int(i)) * weights[i] + float(texelFetch(counts, int(i)).x) +
               float(texelFetch(offsets, int(i)).x);
}
