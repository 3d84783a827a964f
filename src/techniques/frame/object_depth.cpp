// SPDX-License-Identifier: MIT
#include "techniques/frame/object_depth.h"

#include "techniques/frame/scene_depth.h"

namespace luxel {

gpu::Image object_depth(gpu::Recorder& recorder, const Capture& capture, const std::vector<bool>& drawn) {
    gpu::Image depth = recorder.image(capture.gbuffer.hardware_depth.info(), "object depth");
    draw_depth(recorder, *capture.scene, capture.view.world_to_clip, depth, capture.search, drawn);
    return depth;
}

} // namespace luxel
