// SPDX-License-Identifier: MIT
// One diffuse bounce from virtual point lights [Keller1997] on reflective shadow maps [Le2014, 3.2].
#pragma once
#include "techniques/common/vpl.h"
#include "techniques/technique.h"
#include "techniques/vpl/multires.h"

namespace luxel {

enum class VplGather { full, multires };
enum class VplMode { bounded, thesis };

struct VplTechniqueOptions {
    RsmOptions rsm;
    VplOptions vpls;
    VplGather gather = VplGather::full;
    VplMode mode = VplMode::bounded;
    float clamp = 0.0f; // most of a kernel, 1/m2; 0: bounded by the light's area instead
    VplRegionOptions regions;
    void visit(Visitor& v);
};

class VplTechnique final : public Technique {
public:
    Slot slot() const override { return Slot::diffuse; }
    void visit(Visitor& v) override { options_.visit(v); }
    Contribution render(gpu::Recorder& recorder, const Frame& frame) override;

private:
    VplTechniqueOptions options_;
};

// Irradiance of the frame's pixels from the lights, RGBA32F; a = 1 where there is a surface.
gpu::Image vpl_irradiance(gpu::Recorder& recorder, const Frame& frame, const Vpls& vpls,
                          const VplTechniqueOptions& options);

} // namespace luxel
