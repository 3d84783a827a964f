// SPDX-License-Identifier: MIT
// Draws the surfaces of a request into a capture's G-buffer and what they emit into its direct light.
#pragma once
#include "techniques/frame/frame.h"

namespace luxel {

void draw_gbuffer(gpu::Recorder& recorder, const Capture& capture, const CaptureRequest& request);

} // namespace luxel
