// SPDX-License-Identifier: MIT
#include "techniques/vpl/multires.h"

#include <algorithm>

namespace luxel {

void VplRegionOptions::visit(Visitor& v) {
    v.integer("levels", levels, {1, 8}, "regions of 1 to 2^(levels - 1) pixels a side");
    v.real("depth_step", depth_step, {0, 100},
           "least difference of depth that divides a region, as a share of depth");
    v.real("normal_step", normal_step, {0, 2},
           "least difference of a component of the geometric normal that divides a region");
}

namespace {

// Whole cells of the coarsest level.
gpu::ImageInfo padded(const Capture& seen, int levels) {
    const std::uint32_t cell = 1u << (levels - 1);
    return {.width = (seen.width + cell - 1) / cell * cell,
            .height = (seen.height + cell - 1) / cell * cell,
            .mips = std::uint32_t(levels)};
}

// Levels 1 to the coarsest, at least one. The result says which cells are too coarse.
gpu::Image divide(gpu::Recorder& recorder, const Capture& seen, VplRegions& regions) {
    gpu::ImageInfo info = padded(seen, regions.params.coarsest + 1);
    info.width = (info.width + 1) / 2, info.height = (info.height + 1) / 2;
    info.mips = std::uint32_t(std::max(regions.params.coarsest, 1));
    regions.least = recorder.image(info, "vpl least"), regions.most = recorder.image(info, "vpl most");
    info.format = VK_FORMAT_R32_SFLOAT;
    const gpu::Image broken = recorder.image(info, "vpl broken"),
                     divided = recorder.image(info, "vpl divided");
    for (std::uint32_t mip = 0; mip < info.mips; ++mip) {
        gpu::Bindings bindings = {
            {"least", regions.least.mip(mip)}, {"most", regions.most.mip(mip)}, {"broken", broken.mip(mip)}};
        if (mip == 0)
            bindings.insert(bindings.end(), {{"depth", seen.gbuffer.depth},
                                             {"geometric_normal", seen.gbuffer.geometric_normal}});
        else
            bindings.insert(bindings.end(), {{"from_least", regions.least.mip(mip - 1)},
                                             {"from_most", regions.most.mip(mip - 1)}});
        const gpu::Extent cells = extent_of(divided.mip(mip));
        recorder.dispatch(mip == 0 ? "vpl/range_first.comp" : "vpl/range.comp", cells, regions.params,
                          bindings);
        recorder.dispatch("vpl/divide.comp", cells, gpu::Recorder::NoParams{},
                          {{"broken", broken.mip(mip)}, {"divided", divided.mip(mip)}});
    }
    return divided;
}

} // namespace

VplRegions vpl_regions(gpu::Recorder& recorder, const Capture& seen, const VplRegionOptions& options) {
    auto scope = recorder.scope("regions");
    const std::uint32_t levels = std::uint32_t(options.levels);
    VplRegions regions{.cells = recorder.image(padded(seen, options.levels), "vpl cells"),
                       .params = {.view = seen.view,
                                  .level = 0,
                                  .coarsest = options.levels - 1,
                                  .depth_step = options.depth_step,
                                  .normal_step = options.normal_step}};
    const gpu::Image divided = divide(recorder, seen, regions);
    regions.counts = recorder.gpu().buffer(levels * sizeof(int), "vpl region counts");
    regions.arguments = recorder.gpu().buffer(levels * 3 * sizeof(std::uint32_t), "vpl region groups");
    recorder.fill(regions.counts, 0);
    for (std::uint32_t level = 0; level < levels; ++level) {
        const gpu::Image cells = regions.cells.mip(level);
        recorder.clear(cells, {});
        regions.lists.push_back(recorder.gpu().buffer(
            std::uint64_t(cells.width()) * cells.height() * sizeof(std::uint32_t), "vpl regions"));
        shared::VplRegionParams p = regions.params;
        p.level = int(level);
        recorder.dispatch("vpl/regions.comp", extent_of(cells), p,
                          {{"depth", seen.gbuffer.depth},
                           {"divided", divided},
                           {"regions", regions.lists.back()},
                           {"region_counts", regions.counts}});
    }
    recorder.dispatch("vpl/arguments.comp", {levels}, options.levels,
                      {{"region_counts", regions.counts}, {"arguments", regions.arguments}});
    return regions;
}

gpu::Image vpl_interpolate(gpu::Recorder& recorder, const VplRegions& regions) {
    auto scope = recorder.scope("interpolate");
    shared::VplRegionParams p = regions.params;
    for (p.level = p.coarsest; p.level > 0; --p.level) {
        const std::uint32_t level = std::uint32_t(p.level);
        recorder.dispatch("vpl/interpolate.comp", extent_of(regions.cells.mip(level)), p,
                          {{"least", regions.least.mip(level - 1)},
                           {"most", regions.most.mip(level - 1)},
                           {"coarse", regions.cells.mip(level)},
                           {"fine", regions.cells.mip(level - 1)}});
    }
    return regions.cells.mip(0);
}

} // namespace luxel
