// SPDX-License-Identifier: MIT
// Irradiance of earlier frames, found again by reprojection.
#pragma once
#include "gpu/recorder.h"
#include "techniques/isr/isr_params.h"

namespace luxel {

// What is kept from one frame to the next.
struct IsrHistory {
    gpu::Image irradiance, guide, length; // guide: normal, depth; length: frames in the mean
    shared::ViewParams view{};
    int frames = 0; // rendered since the start; turns the samples
};

// What the next frame adds to every pixel's jitter (turn, shift), so that frames use different samples. The
// first adds nothing.
glm::vec2 isr_frame_jitter(const IsrHistory& history);

// The mean over up to `length` frames, which becomes the history. A history of another size is dropped.
gpu::Image isr_accumulate(gpu::Recorder& recorder, const gpu::Image& irradiance, const gpu::Image& guide,
                          const shared::IsrParams& params, int length, IsrHistory& history);

} // namespace luxel
