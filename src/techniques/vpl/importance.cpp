// SPDX-License-Identifier: MIT
#include "techniques/vpl/importance.h"

#include <algorithm>

#include "techniques/vpl/importance_params.h"

namespace luxel {

void VplImportanceOptions::visit(Visitor& v) {
    v.integer("importance", points, {0, 1024},
              "visible points whose light decides which lights are drawn, not with mode=thesis; 0 = by flux");
    v.integer("candidates", candidates, {1, 256}, "pixels of reflective shadow maps for each light, then");
}

namespace {

constexpr int eye_map_size = 32; // texels a side of a visible point's imperfect shadow map
// Lights that no visible point sees may light what lies between these points, or what mirrors show.
constexpr float share_by_flux = 0.1f;

gpu::Buffer light_buffer(gpu::Recorder& recorder, int most, const char* name) {
    return recorder.gpu().buffer(std::uint64_t(std::max(most, 1)) * shared::VPL_TEXELS * sizeof(glm::vec4),
                                 name);
}

Vpls visible_points(gpu::Recorder& recorder, const Frame& frame, int count) {
    Vpls eyes{light_buffer(recorder, count, "vpl eyes"), recorder.gpu().buffer(sizeof(int), "vpl eye count"),
              count};
    recorder.dispatch("vpl/eye_points.comp", {std::uint32_t(count)}, shared::VplEyeParams{frame.view, count},
                      {{"depth", frame.gbuffer.depth},
                       {"geometric_normal", frame.gbuffer.geometric_normal},
                       {"diffuse", frame.gbuffer.diffuse},
                       {"eyes", eyes.lights},
                       {"eye_count", eyes.count}});
    return eyes;
}

} // namespace

Vpls resample_vpls(gpu::Recorder& recorder, const Frame& frame, const Vpls& candidates, int wanted,
                   const VplImportanceOptions& options, const IsmPoints* points) {
    auto scope = recorder.scope("importance");
    const Vpls eyes = visible_points(recorder, frame, options.points);
    IsmMaps ism;
    if (points) ism = imperfect_shadow_maps(recorder, frame, *points, eyes, {.size = eye_map_size});
    const gpu::Buffer importances = recorder.gpu().buffer(
        std::uint64_t(std::max(candidates.most, 1)) * sizeof(glm::vec2), "vpl importances");
    gpu::Bindings bindings = {{"candidates", candidates.lights},
                              {"candidate_count", candidates.count},
                              {"eyes", eyes.lights},
                              {"importances", importances}};
    if (points) bindings.push_back({"shadow_maps", ism.maps});
    recorder.dispatch(points ? "vpl/importance_shadowed.comp" : "vpl/importance_unoccluded.comp",
                      {std::uint32_t(std::max(candidates.most, 1))},
                      shared::VplImportanceParams{options.points, ism.params}, bindings);

    Vpls drawn{light_buffer(recorder, wanted, "vpls"), recorder.gpu().buffer(sizeof(int), "vpl count"),
               wanted};
    recorder.dispatch("vpl/resample.comp", {}, shared::VplResampleParams{wanted, share_by_flux},
                      {{"candidates", candidates.lights},
                       {"candidate_count", candidates.count},
                       {"importances", importances},
                       {"lights", drawn.lights},
                       {"light_count", drawn.count}});
    return drawn;
}

} // namespace luxel
