// SPDX-License-Identifier: MIT
// What one view of the scene shows.
#pragma once
#include "techniques/frame/frame.h"

namespace luxel {

// Its images, before anything is drawn.
Capture capture_images(gpu::Recorder& recorder, const GpuScene& scene, const CaptureRequest& request);

// `direct` holds what the surfaces emit, `direct_diffuse` nothing: DirectLight::render adds the lights.
// search: see Capture.
Capture capture_surfaces(gpu::Recorder& recorder, const GpuScene& scene, const CaptureRequest& request,
                         const std::optional<shared::HeightSearch>& search);

} // namespace luxel
