// SPDX-License-Identifier: MIT
// Which pixels show some of the scene's instances.
#pragma once
#include "techniques/frame/frame.h"

namespace luxel {

// D32F: what `capture` would have as hardware_depth if it drew these instances only (one entry for each of
// the scene's). A pixel with a surface shows one of them where both agree: object_depth.glsl.
gpu::Image object_depth(gpu::Recorder& recorder, const Capture& capture, const std::vector<bool>& drawn);

} // namespace luxel
