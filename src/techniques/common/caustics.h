// SPDX-License-Identifier: MIT
// Caustics by photons that are traced through a distance cube, collected in a cube map and projected on what
// is seen [Umenhoffer2009, chapter 6]. Techniques differ in how they make irradiance of photons.
#pragma once
#include <functional>

#include "techniques/common/caustics_params.h"
#include "techniques/common/cube_trace.h"
#include "techniques/common/light_samples.h"
#include "techniques/technique.h"

namespace luxel {

struct CausticOptions {
    CubeTraceOptions cube{.size = 128};
    int photons = 256; // a side of the photon image of each light and object
    int size = 256;    // texels a side of the caustic cube map
    bool mirrored = true;
    bool reflected = false;
    LightSamples lights;
    void visit(Visitor& v);
};

// What the light of one lamp becomes that meets one specular object.
struct Photons {
    gpu::Image hits;   // RGBA32F: relative to the cube's center, m; a = 1 where there is a photon
    gpu::Image powers; // RGBA32F: W
    int side = 0;
};
// One face of the caustic cube map to draw on, with additive blending.
struct CausticFace {
    gpu::Image target;
    shared::CausticFaceParams params;
};

// Draws photons on all faces; called for each photon image.
using CausticDraw = std::function<void(gpu::Recorder&, const Photons&, const DistanceCube& receivers,
                                       const std::vector<CausticFace>& faces)>;

// Of the scene's own lights, samples of its emitters and of its environment, as they stand in this frame.
Contribution caustics(gpu::Recorder& recorder, const Frame& frame, const std::vector<SceneObject>& specular,
                      const CausticOptions& options, const CausticDraw& draw);

// As cones of that radius in texels, or of the area that a power's a tells, m2, where that is larger.
void splat_photons(gpu::Recorder& recorder, const Photons& photons, const gpu::Image& powers,
                   const DistanceCube& receivers, const CausticFace& face, float radius);

} // namespace luxel
