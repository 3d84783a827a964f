// SPDX-License-Identifier: MIT
// One diffuse bounce from virtual point lights [Keller1997] on reflective shadow maps [Le2014, 3.2].
#pragma once
#include "techniques/common/vpl.h"
#include "techniques/technique.h"
#include "techniques/vpl/ism.h"
#include "techniques/vpl/multires.h"

namespace luxel {

enum class VplGather { full, multires };
enum class VplMode { disc, bounded, thesis };
enum class VplVisibility { none, imperfect_shadow_maps };

struct VplTechniqueOptions {
    RsmOptions rsm;
    VplOptions vpls;
    VplGather gather = VplGather::multires;
    VplMode mode = VplMode::disc;
    float clamp = 0.0f; // mode=bounded: most of a kernel, 1/m2; 0: bounded by the light's area instead
    VplRegionOptions regions;
    VplVisibility visibility = VplVisibility::none;
    IsmOptions ism;
    void visit(Visitor& v);
};

class VplTechnique final : public Technique {
public:
    Slot slot() const override { return Slot::diffuse; }
    void visit(Visitor& v) override { options_.visit(v); }
    void prepare(gpu::Gpu& gpu, const Scene& scene) override;
    Contribution render(gpu::Recorder& recorder, const Frame& frame) override;

private:
    VplTechniqueOptions options_;
    IsmPoints points_; // visibility=imperfect_shadow_maps only
};

// What is summed up: the lights, and their shadow maps unless `ism.maps` is empty.
struct VplSenders {
    Vpls vpls;
    IsmMaps ism;
};
// Irradiance of all regions, into regions.cells.
void vpl_shade(gpu::Recorder& recorder, const Frame& frame, const VplSenders& senders,
               const VplTechniqueOptions& options, const VplRegions& regions);
// Irradiance of the frame's pixels, RGBA32F; a = 1 where there is a surface.
gpu::Image vpl_irradiance(gpu::Recorder& recorder, const Frame& frame, const VplSenders& senders,
                          const VplTechniqueOptions& options);

} // namespace luxel
