// SPDX-License-Identifier: MIT
#include "techniques/vpl/vpl.h"

#include <limits>

namespace luxel {

void VplTechniqueOptions::visit(Visitor& v) {
    vpls.visit(v);
    v.choice("gather", gather, {"full", "multires"},
             "sums at every pixel, or at regions of pixels and interpolated between");
    v.choice("mode", mode, {"bounded", "thesis"},
             "kernel bounded by each light's area, or as printed in the thesis");
    v.real("clamp", clamp, {0, 1e6}, "most of a kernel, 1/m2, instead of the bound by area; 0 = none");
    regions.visit(v);
    rsm.visit(v);
}

namespace {

shared::VplGatherParams gather_params(const Frame& frame, const VplTechniqueOptions& options) {
    const bool clamps = options.clamp > 0.0f;
    return {.view = frame.view,
            .bounded = clamps ? 0.0f : 1.0f,
            .most = clamps ? options.clamp : std::numeric_limits<float>::max(),
            .level = 0};
}

gpu::Bindings gather_bindings(const Frame& frame, const Vpls& vpls) {
    return {{"depth", frame.gbuffer.depth},
            {"normal", frame.gbuffer.normal},
            {"geometric_normal", frame.gbuffer.geometric_normal},
            {"lights", vpls.lights},
            {"light_count", vpls.count}};
}

gpu::Image gather_full(gpu::Recorder& recorder, const Frame& frame, const Vpls& vpls,
                       const VplTechniqueOptions& options) {
    const gpu::Image irradiance =
        recorder.image({.width = frame.width, .height = frame.height}, "vpl irradiance");
    gpu::Bindings bindings = gather_bindings(frame, vpls);
    bindings.push_back({"irradiance", irradiance});
    recorder.dispatch(options.mode == VplMode::thesis ? "vpl/gather_full_thesis.comp"
                                                      : "vpl/gather_full.comp",
                      extent_of(irradiance), gather_params(frame, options), bindings);
    return irradiance;
}

gpu::Image gather_multires(gpu::Recorder& recorder, const Frame& frame, const Vpls& vpls,
                           const VplTechniqueOptions& options) {
    const VplRegions regions = vpl_regions(recorder, frame, options.regions);
    shared::VplGatherParams p = gather_params(frame, options);
    for (; p.level < options.regions.levels; ++p.level) {
        gpu::Bindings bindings = gather_bindings(frame, vpls);
        bindings.insert(bindings.end(), {{"irradiance", regions.cells.mip(std::uint32_t(p.level))},
                                         {"regions", regions.lists[std::size_t(p.level)]},
                                         {"region_counts", regions.counts}});
        recorder.dispatch_indirect(
            options.mode == VplMode::thesis ? "vpl/gather_regions_thesis.comp" : "vpl/gather_regions.comp",
            regions.arguments, std::uint64_t(p.level) * 3 * sizeof(std::uint32_t), p, bindings);
    }
    return vpl_interpolate(recorder, regions);
}

} // namespace

gpu::Image vpl_irradiance(gpu::Recorder& recorder, const Frame& frame, const Vpls& vpls,
                          const VplTechniqueOptions& options) {
    auto scope = recorder.scope("gather");
    return options.gather == VplGather::full ? gather_full(recorder, frame, vpls, options)
                                             : gather_multires(recorder, frame, vpls, options);
}

Contribution VplTechnique::render(gpu::Recorder& recorder, const Frame& frame) {
    auto scope = recorder.scope("vpl");
    const std::vector<RsmView> views = reflective_shadow_maps(recorder, frame, options_.rsm);
    const Vpls vpls = sample_vpls(recorder, views, options_.vpls);
    const gpu::Image irradiance = vpl_irradiance(recorder, frame, vpls, options_);
    const gpu::Image radiance =
        recorder.image({.width = frame.width, .height = frame.height}, "vpl radiance");
    recorder.dispatch(
        "vpl/reflect.comp", extent_of(radiance), gpu::Recorder::NoParams{},
        {{"irradiance", irradiance}, {"diffuse", frame.gbuffer.diffuse}, {"radiance", radiance}});
    return {.radiance = radiance};
}

std::unique_ptr<Technique> make_vpl() { return std::make_unique<VplTechnique>(); }

} // namespace luxel
