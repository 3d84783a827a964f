// SPDX-License-Identifier: MIT
// Draws the surfaces of a request into a capture's G-buffer and what they emit into its direct light.
#pragma once
#include "techniques/frame/frame.h"

namespace luxel {

// A program for each kind of material.
struct SurfaceProgram {
    const char *program, *peeling;
    Surfaces surfaces;
};
inline constexpr SurfaceProgram surface_programs[] = {
    {"frame/gbuffer_plain", "frame/peel_plain", Surfaces::plain},
    {"frame/gbuffer_textured", "frame/peel_textured", Surfaces::textured},
    {"frame/gbuffer_full", "frame/peel_full", Surfaces::full}};

// All targets, cleared; nearer surfaces win. load_targets: what they hold stays.
gpu::RasterPass gbuffer_pass(const Capture& capture);
void load_targets(gpu::RasterPass& pass);

void draw_gbuffer(gpu::Recorder& recorder, const Capture& capture, const CaptureRequest& request);

} // namespace luxel
