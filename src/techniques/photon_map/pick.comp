// SPDX-License-Identifier: MIT
// First hits: the non-empty cells of the finest level of the flux pyramid that has no more of them than photons are wanted
// [Le2014, 3.3.1.1], as a list: few of a shadow map's pixels are specular. The thesis drops cells that are so in part.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "techniques/photon_map/photon_map_params.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0, scalar) uniform params { PhotonPickParams p; };
layout(binding = 1) uniform sampler2D sums;
layout(binding = 2, scalar) readonly buffer counts { uint count_of[]; };
layout(binding = 3, scalar) buffer picked { PickedCells cells; uint cell_of[]; };

void main() {
    int level = 0;
    while (level + 1 < p.levels && count_of[PHOTON_LEVELS + level] > uint(p.most)) ++level;
    level = min(level, textureQueryLevels(sums) - 1); // of a smaller shadow map
    ivec2 cell = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(cell, textureSize(sums, level)))) return;
    float pixels = texelFetch(sums, cell, level).a;
    if (pixels == 0.0 || (p.mixed == 0u && pixels < float(1 << (2 * level)))) return;
    uint index = atomicAdd(cells.end, 1u) - 1u;
    atomicMax(cells.groups.x, index / PHOTON_GROUP + 1u);
    cells.level = level;
    cell_of[index] = uint(cell.x) | uint(cell.y) << 16;
}
