// SPDX-License-Identifier: MIT
#include "techniques/frame/gbuffer.h"

namespace luxel {

void draw_gbuffer(gpu::Recorder& recorder, const Frame& frame) {
    auto scope = recorder.scope("gbuffer");
    const GBuffer& g = frame.gbuffer;
    const GpuScene& scene = *frame.scene;
    const Frustum frustum = frustum_of(frame.view.world_to_clip);

    // Depth of what is opaque comes first, so that each pixel is shaded about once.
    gpu::DepthTarget depth{
        .image = g.hardware_depth, .clear = 0.0f, .compare = VK_COMPARE_OP_GREATER_OR_EQUAL};
    recorder.draw("frame/depth", {.depth = depth}, frame.view.world_to_clip,
                  scene.vertex_bindings(MaterialUse::none), scene.indices(),
                  scene.batches(frustum, Surfaces::opaque, MaterialUse::none));
    depth.clear.reset();

    // One program for each kind of material; the first clears.
    gpu::RasterPass pass{.depth = depth};
    const std::array<float, 4> black{};
    for (const gpu::Image& image :
         {g.diffuse, g.specular, g.normal, g.geometric_normal, g.depth, frame.direct})
        pass.color.push_back({image, black});
    struct Kind {
        const char* program;
        Surfaces surfaces;
    };
    for (const Kind& kind :
         {Kind{"frame/gbuffer_plain", Surfaces::plain}, Kind{"frame/gbuffer_textured", Surfaces::textured},
          Kind{"frame/gbuffer_full", Surfaces::full}}) {
        std::vector<gpu::Batch> batches = scene.batches(frustum, kind.surfaces, MaterialUse::all);
        if (batches.empty() && kind.surfaces != Surfaces::plain) continue;
        recorder.draw(kind.program, pass, frame.view, scene.vertex_bindings(MaterialUse::all),
                      scene.indices(), batches);
        for (gpu::ColorTarget& target : pass.color) target.clear.reset();
    }
}

} // namespace luxel
