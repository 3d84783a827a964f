// SPDX-License-Identifier: MIT
#include "techniques/common/object_depth.h"

namespace luxel {

gpu::Image object_depth(gpu::Recorder& recorder, const Capture& capture, const std::vector<bool>& drawn) {
    gpu::Image depth = recorder.image(capture.gbuffer.hardware_depth.info(), "object depth");
    const GpuScene& scene = *capture.scene;
    const Frustum frustum = frustum_of(capture.view.world_to_clip);
    gpu::RasterPass pass{
        .depth = gpu::DepthTarget{.image = depth, .clear = 0.0f, .compare = VK_COMPARE_OP_GREATER_OR_EQUAL}};
    recorder.draw("frame/depth", pass, capture.view.world_to_clip, scene.vertex_bindings(MaterialUse::none),
                  scene.indices(), scene.batches(frustum, Surfaces::opaque, MaterialUse::none, drawn));
    std::vector<gpu::Batch> masked = scene.batches(frustum, Surfaces::masked, MaterialUse::alpha, drawn);
    if (masked.empty()) return depth;
    pass.depth->clear.reset();
    recorder.draw("frame/depth_mask", pass, capture.view.world_to_clip,
                  scene.vertex_bindings(MaterialUse::alpha), scene.indices(), masked);
    return depth;
}

} // namespace luxel
