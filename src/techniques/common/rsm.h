// SPDX-License-Identifier: MIT
// Reflective shadow maps: what each light of the frame sees, with the flux that arrives there
// [Dachsbacher2005] [Le2014, 3.2.1].
#pragma once
#include <vector>

#include "techniques/common/light_samples.h"
#include "techniques/frame/frame.h"

namespace luxel {

struct RsmOptions {
    int size = 512; // pixels a side of a directional or spot light's view, see rsm_views
    LightSamples lights;
    void visit(Visitor& v);
};

// One view from a light: one of a directional light or a spot up to 120 degrees, one of several faces of
// others.
struct RsmView {
    Capture seen; // surfaces; `direct` has their emission and signed_ior, `direct_diffuse` nothing
    shared::Light light;
    gpu::Image flux; // RGBA32F: incident flux of the pixel, W, also on specular surfaces; 0 where nothing is
                     // seen. a = 1 on specular surfaces (signed_ior is not 0), else 0
    gpu::Image reflected; // RGBA32F: the share of it that the Lambertian lobe reflects
};

// Views of `size` pixels a side around what a light can reach. Spot: its outer cone, whose circle touches the
// image's sides. Point: 6 faces of a cube; cosine and wider spots: 5. Directional: a parallel view around the
// scene.
std::vector<shared::ViewParams> rsm_views(const shared::Light& light, const Bounds& scene, int size);

// Of the frame's lights as they stand in this frame, in order of lights, then views. Faces of cubes have half
// of options.size, views of samples half of theirs.
std::vector<RsmView> reflective_shadow_maps(gpu::Recorder& recorder, const Frame& frame,
                                            const RsmOptions& options);

} // namespace luxel
