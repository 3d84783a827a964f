// SPDX-License-Identifier: MIT
// What a pass over cells of one level writes: the range of its pixels and whether it holds a discontinuity.
#extension GL_EXT_scalar_block_layout : require
#include "techniques/vpl/vpl_params.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0, scalar) uniform params { VplRegionParams p; };
layout(binding = 1, rgba32f) uniform writeonly image2D least; // normal, depth
layout(binding = 2, rgba32f) uniform writeonly image2D most;
layout(binding = 3, r32f) uniform writeonly image2D broken; // 1 where there is one

void store_range(ivec2 cell, vec4 low, vec4 high) {
    imageStore(least, cell, low);
    imageStore(most, cell, high);
    SurfaceRange r = SurfaceRange(low.xyz, high.xyz, low.w, high.w);
    imageStore(broken, cell, vec4(is_discontinuous(r, p.depth_step, p.normal_step) ? 1.0 : 0.0));
}
