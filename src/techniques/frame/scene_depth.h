// SPDX-License-Identifier: MIT
// The depth of a scene's surfaces alone: for shadow maps, and to tell instances apart.
#pragma once
#include <optional>
#include <vector>

#include "shared/height_search.h"
#include "techniques/frame/gpu_scene.h"

namespace luxel {

// Nearest surfaces, both sides, into `map` (D32F, reversed), cleared before. search: of height maps; none:
// they are not looked at. drawn: one entry for each of the scene's instances; empty: all.
void draw_depth(gpu::Recorder& recorder, const GpuScene& scene, const glm::mat4& world_to_clip,
                const gpu::Image& map, const std::optional<shared::HeightSearch>& search,
                const std::vector<bool>& drawn = {});

} // namespace luxel
