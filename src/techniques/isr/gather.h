// SPDX-License-Identifier: MIT
// From patches to irradiance.
#pragma once
#include <vector>

#include "techniques/isr/patches.h"

namespace luxel {

// Tap table of one mode: xy = offset, z = weight in coarse pixels; ISR_MAX_TAPS entries, the first `count` in
// use.
std::vector<glm::vec4> isr_taps(const shared::IsrParams& params);

// Taps of a range of depth.
struct IsrTable {
    gpu::Buffer taps;
    int count = 0;
    float nearest = 0, farthest = 0; // of the receivers that it is for
};
// One for all receivers, or a second for those beyond options.far.
std::vector<IsrTable> isr_tables(gpu::Gpu& gpu, const IsrOptions& options, const shared::IsrParams& params);

// Irradiance of the frame's coarse pixels from `senders`, a = accessibility.
gpu::Image isr_gather(gpu::Recorder& recorder, const IsrSenders& senders, const gpu::Image& receiver,
                      const std::vector<IsrTable>& tables, const shared::IsrParams& params);

// The same from an additional camera's senders; a = 1.
gpu::Image isr_gather_camera(gpu::Recorder& recorder, const IsrSenders& senders, const gpu::Image& receiver,
                             int taps, const shared::IsrParams& params);

// What a bounce's irradiance sends on: albedo/pi E. Pixels beyond the frame's border send nothing.
gpu::Image isr_reflect(gpu::Recorder& recorder, const gpu::Image& irradiance, const gpu::Image& albedo,
                       const shared::IsrParams& params);

} // namespace luxel
