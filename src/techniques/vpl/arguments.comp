// SPDX-License-Identifier: MIT
// Work groups of 64 regions for each level.
#version 460
#extension GL_EXT_scalar_block_layout : require

layout(local_size_x = 16) in;
layout(binding = 0, scalar) readonly buffer region_counts { int region_count[]; };
layout(binding = 1, scalar) writeonly buffer arguments { uint group_count[]; };

void main() {
    int level = int(gl_GlobalInvocationID.x);
    if (level >= region_count.length()) return;
    group_count[3 * level] = uint(region_count[level] + 63) / 64u;
    group_count[3 * level + 1] = 1u, group_count[3 * level + 2] = 1u;
}
