// SPDX-License-Identifier: MIT
// Draws the visible surfaces into a capture's G-buffer and what they emit into its direct light.
#pragma once
#include "techniques/frame/frame.h"

namespace luxel {

// farther_than: see CaptureRequest; may be empty.
void draw_gbuffer(gpu::Recorder& recorder, const Capture& capture, const gpu::Image& farther_than);

} // namespace luxel
