// SPDX-License-Identifier: MIT
// Work groups of 64 regions for each level.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

layout(local_size_x = 16) in;
layout(binding = 2, scalar) uniform params { int levels; };
layout(binding = 0, scalar) readonly buffer region_counts { int region_count[]; };
layout(binding = 1, scalar) writeonly buffer arguments { uint group_count[]; };

void main() {
    int level = int(gl_GlobalInvocationID.x);
    if (level >= levels) return;
    // In rows, as a device need not take more than 65 535 groups along one axis.
    const uint row = 32768u;
    uint groups = uint(region_count[level] + 63) / 64u;
    group_count[3 * level] = min(groups, row);
    group_count[3 * level + 1] = (groups + row - 1u) / row;
    group_count[3 * level + 2] = 1u;
}
