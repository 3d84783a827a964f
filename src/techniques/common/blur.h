// SPDX-License-Identifier: MIT
// Separable Gaussian blur in two passes.
#pragma once
#include "gpu/recorder.h"
#include "techniques/common/blur_params.h"

namespace luxel {

struct Blur {
    float sigma = 1.5f;           // pixels
    float depth_tolerance = 0.0f; // see BlurParams; 0 = plain Gaussian
};

// RGBA32F in and out. guide: normal in rgb, linear depth in a (0 = nothing there).
gpu::Image blur(gpu::Recorder& recorder, const gpu::Image& from, const gpu::Image& guide,
                const Blur& settings);

} // namespace luxel
