// SPDX-License-Identifier: MIT
// One view of the scene: G-buffer and direct light.
#pragma once
#include "techniques/frame/direct_light.h"
#include "techniques/frame/frame.h"

namespace luxel {

Capture capture_scene(gpu::Recorder& recorder, const GpuScene& scene, const DirectLight& lights,
                      const CaptureRequest& request);

} // namespace luxel
