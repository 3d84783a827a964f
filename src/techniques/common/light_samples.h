// SPDX-License-Identifier: MIT
// The lights that a technique starts from: the scene's own and samples of what else shines.
#pragma once
#include <vector>

#include "core/parameters.h"
#include "scene/scene.h"
#include "techniques/frame/frame.h"
#include "techniques/technique.h"

namespace luxel {

struct LightSamples {
    int emitters = 8, environment = 8;
    void visit(Visitor& v); // emitter_lights, environment_lights
};

// As they stand in this frame: emitters move with their instances.
std::vector<shared::Light> lights_with_samples(const Scene& scene, const LightSamples& samples);

// A light that starts paths: one of these, or one of the frame's.
Need light_need(const Scene& scene, const LightSamples& samples);
Need light_need(const Scene& scene, const FrameOptions& frame);

} // namespace luxel
