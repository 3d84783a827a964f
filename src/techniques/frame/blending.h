// SPDX-License-Identifier: MIT
// Alpha-blended surfaces: what covers a part of its pixel is no surface of the frame but a layer over it.
#pragma once
#include <vector>

#include "techniques/frame/frame.h"

namespace luxel {

// The scene's instances that may cover a part of a pixel; empty: there are none.
std::vector<bool> blended_instances(const Scene& scene);

// Layers of the view, nearest first, at most `most`; surfaces only, no light yet.
std::vector<Capture> blended_layers(gpu::Recorder& recorder, const GpuScene& scene,
                                    const shared::ViewParams& view, const std::vector<bool>& instances,
                                    int most, const std::optional<shared::HeightSearch>& search);

} // namespace luxel
