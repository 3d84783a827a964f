// SPDX-License-Identifier: MIT
// Draws the visible surfaces into a frame's G-buffer and what they emit into its direct light.
#pragma once
#include "techniques/frame/frame.h"

namespace luxel {

void draw_gbuffer(gpu::Recorder& recorder, const Frame& frame);

} // namespace luxel
