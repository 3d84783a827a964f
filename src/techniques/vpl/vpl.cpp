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
    v.only_if(mode == VplMode::bounded, "mode=bounded", [&] {
        v.real("clamp", clamp, {0, 1e6}, "most of a kernel, 1/m2, instead of the bound by area; 0 = none");
    });
    v.choice("visibility", visibility, {"automatic", "none", "imperfect_shadow_maps"},
             "of lights: by a small map of points for each, with mode=disc; or whatever lies between");
    v.only_if(gather == VplGather::multires, "gather=multires", [&] { regions.visit(v); });
    v.only_if(has_shadows(), "imperfect shadow maps", [&] { ism.visit(v); });
    importance.visit(v);
    rsm.visit(v);
}

namespace {

shared::VplGatherParams gather_params(const Capture& seen, const VplSenders& senders,
                                      const VplTechniqueOptions& options) {
    const bool clamps = options.clamp > 0.0f;
    return {.view = seen.view,
            .bounded = clamps ? 0.0f : 1.0f,
            .most = clamps ? options.clamp : std::numeric_limits<float>::max(),
            .level = 0,
            .ism = senders.ism.params};
}

gpu::Bindings gather_bindings(const Capture& seen, const VplSenders& senders) {
    gpu::Bindings bindings = {{"depth", seen.gbuffer.depth},
                              {"normal", seen.gbuffer.normal},
                              {"geometric_normal", seen.gbuffer.geometric_normal},
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

gpu::Image gather_full(gpu::Recorder& recorder, const Capture& seen, const VplSenders& senders,
                       const VplTechniqueOptions& options) {
    const gpu::Image irradiance =
        recorder.image({.width = seen.width, .height = seen.height}, "vpl irradiance");
    gpu::Bindings bindings = gather_bindings(seen, senders);
    bindings.push_back({"irradiance", irradiance});
    recorder.dispatch(variant("vpl/gather_full", senders, options), extent_of(irradiance),
                      gather_params(seen, senders, options), bindings);
    return irradiance;
}

} // namespace

void vpl_shade(gpu::Recorder& recorder, const Capture& seen, const VplSenders& senders,
               const VplTechniqueOptions& options, const VplRegions& regions) {
    shared::VplGatherParams p = gather_params(seen, senders, options);
    for (; p.level <= regions.params.coarsest; ++p.level) {
        gpu::Bindings bindings = gather_bindings(seen, senders);
        bindings.insert(bindings.end(), {{"irradiance", regions.cells.mip(std::uint32_t(p.level))},
                                         {"regions", regions.lists[std::size_t(p.level)]},
                                         {"region_counts", regions.counts}});
        recorder.dispatch_indirect(variant("vpl/gather_regions", senders, options), regions.arguments,
                                   std::uint64_t(p.level) * 3 * sizeof(std::uint32_t), p, bindings);
    }
}

gpu::Image vpl_irradiance(gpu::Recorder& recorder, const Capture& seen, const VplSenders& senders,
                          const VplTechniqueOptions& options) {
    auto scope = recorder.scope("gather");
    if (options.gather == VplGather::full) return gather_full(recorder, seen, senders, options);
    const VplRegions regions = vpl_regions(recorder, seen, options.regions);
    vpl_shade(recorder, seen, senders, options, regions);
    return vpl_interpolate(recorder, regions);
}

bool VplTechnique::shadows() const { return options_.has_shadows(); }

void VplTechnique::prepare(gpu::Gpu&, const Scene&) { points_.reset(); }

// Again when the eye has moved by as much as changes their density.
void VplTechnique::place_points(gpu::Gpu& gpu, const Scene& scene, glm::vec3 eye) {
    if (points_ && glm::length(eye - points_for_) < 0.25f * ism_near(scene)) return;
    points_ = ism_points(gpu, scene, options_.ism, eye);
    points_for_ = eye;
}

Vpls VplTechnique::draw_lights(gpu::Recorder& recorder, const Frame& frame) const {
    const std::vector<RsmView> views = reflective_shadow_maps(recorder, frame, options_.rsm);
    if (options_.mode == VplMode::thesis || options_.importance.points == 0)
        return sample_vpls(recorder, views, options_.vpls);
    VplOptions more = options_.vpls;
    more.count *= options_.importance.candidates;
    const Vpls candidates = sample_vpls(recorder, views, more);
    return resample_vpls(recorder, frame, candidates, options_.vpls.count, options_.importance,
                         shadows() ? &*points_ : nullptr);
}

Contribution VplTechnique::render(gpu::Recorder& recorder, const Frame& frame) {
    auto scope = recorder.scope("vpl");
    if (shadows() && options_.mode != VplMode::disc)
        fail(Fault::usage, "vpl: visibility=imperfect_shadow_maps is for mode=disc only");
    if (shadows()) place_points(recorder.gpu(), frame.scene->scene(), frame.camera.position);
    senders_ = {};
    senders_.vpls = draw_lights(recorder, frame);
    if (shadows())
        senders_.ism = imperfect_shadow_maps(recorder, frame, *points_, senders_.vpls, options_.ism);
    return {.radiance = radiance_of(recorder, frame)};
}

void VplTechnique::light(gpu::Recorder& recorder, const Frame&, const std::vector<Capture>& captures) {
    auto scope = recorder.scope("vpl");
    for (const Capture& seen : captures)
        recorder.dispatch("frame/add.comp", extent_of(seen.direct), gpu::Recorder::NoParams{},
                          {{"contribution", radiance_of(recorder, seen)}, {"radiance", seen.direct}});
}

gpu::Image VplTechnique::radiance_of(gpu::Recorder& recorder, const Capture& seen) const {
    const gpu::Image irradiance = vpl_irradiance(recorder, seen, senders_, options_);
    gpu::Image radiance = recorder.image({.width = seen.width, .height = seen.height}, "vpl radiance");
    recorder.dispatch(
        "common/reflect.comp", extent_of(radiance), gpu::Recorder::NoParams{},
        {{"irradiance", irradiance}, {"diffuse", seen.gbuffer.diffuse}, {"radiance", radiance}});
    return radiance;
}

std::unique_ptr<Technique> make_vpl() { return std::make_unique<VplTechnique>(); }

} // namespace luxel
