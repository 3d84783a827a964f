// SPDX-License-Identifier: MIT
#include "techniques/vpl/vpl.h"

#include <limits>

#include "core/error.h"

namespace luxel {

void VplTechniqueOptions::visit(Visitor& v) {
    vpls.visit(v);
    v.choice("gather", gather, {"full", "multires"},
             "sums at every pixel, or at regions of pixels and interpolated between");
    v.choice("mode", mode, {"disc", "bounded", "thesis"},
             "kernel: lights as discs of their area, as points bounded by it, or as printed in the thesis");
    v.real("clamp", clamp, {0, 1e6},
           "mode=bounded: most of a kernel, 1/m2, instead of the bound by area; 0 = none");
    v.choice("visibility", visibility, {"none", "imperfect_shadow_maps"},
             "of lights: whatever lies between, or by a small map of points for each");
    regions.visit(v);
    ism.visit(v);
    rsm.visit(v);
}

namespace {

shared::VplGatherParams gather_params(const Frame& frame, const VplSenders& senders,
                                      const VplTechniqueOptions& options) {
    const bool clamps = options.clamp > 0.0f;
    return {.view = frame.view,
            .bounded = clamps ? 0.0f : 1.0f,
            .most = clamps ? options.clamp : std::numeric_limits<float>::max(),
            .level = 0,
            .ism = senders.ism.params};
}

gpu::Bindings gather_bindings(const Frame& frame, const VplSenders& senders) {
    gpu::Bindings bindings = {{"depth", frame.gbuffer.depth},
                              {"normal", frame.gbuffer.normal},
                              {"geometric_normal", frame.gbuffer.geometric_normal},
                              {"lights", senders.vpls.lights},
                              {"light_count", senders.vpls.count}};
    if (senders.ism.maps) bindings.push_back({"shadow_maps", senders.ism.maps});
    return bindings;
}

// The variant of a gathering program.
std::string variant(const std::string& program, const VplSenders& senders,
                    const VplTechniqueOptions& options) {
    static constexpr const char* kernels[] = {"_disc.comp", "_bounded.comp", "_thesis.comp"};
    return program + (senders.ism.maps ? "_shadowed.comp" : kernels[std::size_t(options.mode)]);
}

gpu::Image gather_full(gpu::Recorder& recorder, const Frame& frame, const VplSenders& senders,
                       const VplTechniqueOptions& options) {
    const gpu::Image irradiance =
        recorder.image({.width = frame.width, .height = frame.height}, "vpl irradiance");
    gpu::Bindings bindings = gather_bindings(frame, senders);
    bindings.push_back({"irradiance", irradiance});
    recorder.dispatch(variant("vpl/gather_full", senders, options), extent_of(irradiance),
                      gather_params(frame, senders, options), bindings);
    return irradiance;
}

} // namespace

void vpl_shade(gpu::Recorder& recorder, const Frame& frame, const VplSenders& senders,
               const VplTechniqueOptions& options, const VplRegions& regions) {
    shared::VplGatherParams p = gather_params(frame, senders, options);
    for (; p.level <= regions.params.coarsest; ++p.level) {
        gpu::Bindings bindings = gather_bindings(frame, senders);
        bindings.insert(bindings.end(), {{"irradiance", regions.cells.mip(std::uint32_t(p.level))},
                                         {"regions", regions.lists[std::size_t(p.level)]},
                                         {"region_counts", regions.counts}});
        recorder.dispatch_indirect(variant("vpl/gather_regions", senders, options), regions.arguments,
                                   std::uint64_t(p.level) * 3 * sizeof(std::uint32_t), p, bindings);
    }
}

gpu::Image vpl_irradiance(gpu::Recorder& recorder, const Frame& frame, const VplSenders& senders,
                          const VplTechniqueOptions& options) {
    auto scope = recorder.scope("gather");
    if (options.gather == VplGather::full) return gather_full(recorder, frame, senders, options);
    const VplRegions regions = vpl_regions(recorder, frame, options.regions);
    vpl_shade(recorder, frame, senders, options, regions);
    return vpl_interpolate(recorder, regions);
}

void VplTechnique::prepare(gpu::Gpu& gpu, const Scene& scene) {
    points_ = {};
    if (options_.visibility == VplVisibility::imperfect_shadow_maps)
        points_ = ism_points(gpu, scene, options_.ism);
}

Contribution VplTechnique::render(gpu::Recorder& recorder, const Frame& frame) {
    auto scope = recorder.scope("vpl");
    const bool shadows = options_.visibility == VplVisibility::imperfect_shadow_maps;
    if (shadows && options_.mode != VplMode::disc)
        fail(Fault::usage, "vpl: visibility=imperfect_shadow_maps is for mode=disc only");
    VplSenders senders;
    senders.vpls =
        sample_vpls(recorder, reflective_shadow_maps(recorder, frame, options_.rsm), options_.vpls);
    if (shadows) senders.ism = imperfect_shadow_maps(recorder, frame, points_, senders.vpls, options_.ism);
    const gpu::Image irradiance = vpl_irradiance(recorder, frame, senders, options_);
    const gpu::Image radiance =
        recorder.image({.width = frame.width, .height = frame.height}, "vpl radiance");
    recorder.dispatch(
        "common/reflect.comp", extent_of(radiance), gpu::Recorder::NoParams{},
        {{"irradiance", irradiance}, {"diffuse", frame.gbuffer.diffuse}, {"radiance", radiance}});
    return {.radiance = radiance};
}

std::unique_ptr<Technique> make_vpl() { return std::make_unique<VplTechnique>(); }

} // namespace luxel
