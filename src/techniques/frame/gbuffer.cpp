// SPDX-License-Identifier: MIT
#include "techniques/frame/gbuffer.h"

namespace luxel {

namespace {

struct Kind {
    const char *program, *peeling;
    Surfaces surfaces;
};
constexpr Kind kinds[] = {{"frame/gbuffer_plain", "frame/peel_plain", Surfaces::plain},
                          {"frame/gbuffer_textured", "frame/peel_textured", Surfaces::textured},
                          {"frame/gbuffer_full", "frame/peel_full", Surfaces::full}};

} // namespace

void draw_gbuffer(gpu::Recorder& recorder, const Capture& capture, const gpu::Image& farther_than) {
    auto scope = recorder.scope("gbuffer");
    const GBuffer& g = capture.gbuffer;
    const GpuScene& scene = *capture.scene;
    const Frustum frustum = frustum_of(capture.view.world_to_clip);

    // Depth of what is opaque comes first, so that each pixel is shaded about once. It cannot peel: which
    // surfaces have a back is their material's business.
    gpu::DepthTarget depth{
        .image = g.hardware_depth, .clear = 0.0f, .compare = VK_COMPARE_OP_GREATER_OR_EQUAL};
    if (!farther_than) {
        recorder.draw("frame/depth", {.depth = depth}, capture.view.world_to_clip,
                      scene.vertex_bindings(MaterialUse::none), scene.indices(),
                      scene.batches(frustum, Surfaces::opaque, MaterialUse::none));
        depth.clear.reset();
    }

    // One program for each kind of material; the first clears.
    gpu::RasterPass pass{.depth = depth};
    const std::array<float, 4> black{};
    for (const gpu::Image& image :
         {g.diffuse, g.specular, g.normal, g.geometric_normal, g.depth, capture.direct})
        pass.color.push_back({image, black});
    gpu::Bindings bindings = scene.vertex_bindings(MaterialUse::all);
    if (farther_than) bindings.push_back({"farther_than", farther_than});
    for (const Kind& kind : kinds) {
        std::vector<gpu::Batch> batches = scene.batches(frustum, kind.surfaces, MaterialUse::all);
        if (batches.empty() && kind.surfaces != Surfaces::plain) continue;
        recorder.draw(farther_than ? kind.peeling : kind.program, pass, capture.view, bindings,
                      scene.indices(), batches);
        for (gpu::ColorTarget& target : pass.color) target.clear.reset();
        pass.depth->clear.reset();
    }
}

} // namespace luxel
