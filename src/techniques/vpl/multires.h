// SPDX-License-Identifier: MIT
// Regions of pixels that share a sum: squares of 1, 2, 4, ... pixels a side, without a discontinuity in them
// or in the squares beside them [Nichols2009] [Le2014, 3.2.2].
#pragma once
#include <vector>

#include "techniques/frame/frame.h"
#include "techniques/vpl/vpl_params.h"

namespace luxel {

struct VplRegionOptions {
    int levels = 5;           // 1, 2, ..., 2^(levels - 1) pixels a side
    float depth_step = 0.02f; // least discontinuity of depth, as a share of it
    float normal_step = 0.2f; // least discontinuity of a component of the geometric normal
    void visit(Visitor& v);
};

// Every pixel of a surface is in exactly one region.
struct VplRegions {
    std::vector<gpu::Buffer> lists; // by level: cells, x + 65536 y
    gpu::Buffer counts;             // int of each level
    gpu::Buffer arguments;          // of indirect dispatches, 64 regions to a group
    gpu::Image least, most;         // RGBA32F: range of geometric normal and depth; mip m is level m + 1
    gpu::Image cells;               // RGBA32F, mip m is level m: for what is shaded; a = 0 everywhere
    shared::VplRegionParams params; // of level 0
};

VplRegions vpl_regions(gpu::Recorder& recorder, const Capture& seen, const VplRegionOptions& options);

// Fills the gaps of regions.cells when each level's regions are shaded. The result is padded to whole cells.
gpu::Image vpl_interpolate(gpu::Recorder& recorder, const VplRegions& regions);

} // namespace luxel
