// SPDX-License-Identifier: MIT
// One diffuse bounce from virtual point lights [Keller1997] on reflective shadow maps [Le2014, 3.2].
#pragma once
#include "techniques/common/vpl.h"
#include "techniques/technique.h"
#include "techniques/vpl/importance.h"
#include "techniques/vpl/ism.h"
#include "techniques/vpl/multires.h"

namespace luxel {

enum class VplGather { full, multires };
enum class VplMode { disc, bounded, thesis };
// automatic: imperfect shadow maps for discs, none for other kernels.
enum class VplVisibility { automatic, none, imperfect_shadow_maps };

struct VplTechniqueOptions {
    RsmOptions rsm;
    VplOptions vpls;
    VplGather gather = VplGather::multires;
    VplMode mode = VplMode::disc;
    float clamp = 0.0f; // mode=bounded: most of a kernel, 1/m2; 0: bounded by the light's area instead
    VplRegionOptions regions;
    VplVisibility visibility = VplVisibility::automatic;
    IsmOptions ism;
    VplImportanceOptions importance;
    void visit(Visitor& v);
    bool has_shadows() const {
        return visibility == VplVisibility::imperfect_shadow_maps ||
               (visibility == VplVisibility::automatic && mode == VplMode::disc);
    }
};

// What is summed up: the lights, and their shadow maps unless `ism.maps` is empty.
struct VplSenders {
    Vpls vpls;
    IsmMaps ism;
};

class VplTechnique final : public Technique {
public:
    Slot slot() const override { return Slot::diffuse; }
    bool takes_parallel_views() const override { return true; }
    std::vector<std::string> components() const override { return {"diffuse1"}; }
    std::vector<Need> needs(const Scene& scene, const FrameOptions&) const override {
        return {light_need(scene, options_.rsm.lights)};
    }
    void visit(Visitor& v) override { options_.visit(v); }
    void prepare(gpu::Gpu& gpu, const Scene& scene) override;
    Contribution render(gpu::Recorder& recorder, const Frame& frame) override;
    void light(gpu::Recorder& recorder, const Frame& frame, const std::vector<Capture>& captures) override;

private:
    void place_points(gpu::Gpu& gpu, const Scene& scene, glm::vec3 eye);
    Vpls draw_lights(gpu::Recorder& recorder, const Frame& frame) const;
    bool shadows() const;
    gpu::Image radiance_of(gpu::Recorder& recorder, const Capture& seen) const;

    VplTechniqueOptions options_;
    std::optional<IsmPoints> points_; // with shadows() only
    glm::vec3 points_for_{0.0f};      // the eye that they are for
    VplSenders senders_;              // of the latest frame
};

// Irradiance of all regions, into regions.cells.
void vpl_shade(gpu::Recorder& recorder, const Capture& seen, const VplSenders& senders,
               const VplTechniqueOptions& options, const VplRegions& regions);
// Irradiance of the view's pixels, RGBA32F; a = 1 where there is a surface.
gpu::Image vpl_irradiance(gpu::Recorder& recorder, const Capture& seen, const VplSenders& senders,
                          const VplTechniqueOptions& options);

} // namespace luxel
