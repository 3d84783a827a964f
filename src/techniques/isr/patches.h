// SPDX-License-Identifier: MIT
// The patches that send light: coarse pixels of the frame, of its surroundings, of what it hides, and of
// further views.
#pragma once
#include <vector>

#include "techniques/frame/frame.h"
#include "techniques/isr/isr_params.h"

namespace luxel {

struct IsrOptions;

// RGBA32F of one size.
struct IsrSenders {
    gpu::Image patches;      // area vector, depth (0 = none)
    gpu::Image source;       // radiance
    shared::ViewParams view; // of an additional camera
};

struct IsrPatches {
    IsrSenders visible;
    gpu::Image receiver; // shading normal, depth, of the frame's own coarse pixels
    gpu::Image albedo;
    IsrSenders hidden; // behind the visible ones, pixel by pixel; empty with layers=1
    std::vector<IsrSenders> cameras;
};

shared::IsrParams isr_params(const IsrOptions& options, const Frame& frame);

IsrPatches isr_patches(gpu::Recorder& recorder, const Frame& frame, const IsrOptions& options,
                       const shared::IsrParams& params);

// The view of all coarse pixels of `params`, those beyond the frame included. Where the frame's size is odd,
// its pixels lie a quarter of a coarse pixel beside the frame's.
shared::ViewParams isr_wide_view(const shared::IsrParams& params);

// Additional cameras: square views of 90 degrees from the eye, in this order back, left, right, up, down.
// With a front of 90 degrees, which frame and border cover, they see all around; none sees what another does.
std::vector<shared::ViewParams> isr_cameras(const shared::ViewParams& view, int count, int size);

} // namespace luxel
