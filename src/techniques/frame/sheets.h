// SPDX-License-Identifier: MIT
// Thin sheets as lights see them: what they take from the light that goes straight through. Shadow maps hold
// what is solid; these images say how much gets that far.
#pragma once
#include "gpu/recorder.h"
#include "techniques/frame/gpu_scene.h"

namespace luxel {

struct SheetTargets {
    gpu::Image
        optical_depth;  // RGBA16F: rgb = -log of the share that passes all sheets in front of what is solid
    gpu::Image nearest; // R32F: reversed depth of the first of them, 0 where there is none
};
// Formats of the images that draw_sheets() fills.
inline constexpr VkFormat optical_depth_format = VK_FORMAT_R16G16B16A16_SFLOAT,
                          nearest_sheet_format = VK_FORMAT_R32_SFLOAT;

// Whether any sheet touches the view.
bool sees_sheets(const GpuScene& scene, const glm::mat4& world_to_clip);

// solid: the depth of all else in this view (draw_depth() of GpuScene::solids()).
void draw_sheets(gpu::Recorder& recorder, const GpuScene& scene, const glm::mat4& world_to_clip,
                 const gpu::Image& solid, const SheetTargets& targets);

} // namespace luxel
