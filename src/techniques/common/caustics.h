// SPDX-License-Identifier: MIT
// Caustics by photons that are traced through a distance cube, collected in a cube map and projected on what
// is seen [Umenhoffer2009, chapter 6]. Techniques differ in how they make irradiance of photons.
#pragma once
#include <vector>

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

// What photons light around one center.
struct CausticMap {
    DistanceCube receivers; // one layer
    float texel = 0.0f;     // of its distances, radians
    gpu::Image irradiance;  // cube
};

// Of the scene's own lights, samples of its emitters and of its environment, as they stand in this frame.
class CausticTechnique : public Technique {
public:
    Slot slot() const override { return Slot::caustics; }
    std::vector<std::string> components() const override { return {"caustics"}; }
    std::vector<Need> needs(const Scene& scene, const FrameOptions&) const override {
        return {specular_need(specular_objects(scene)), light_need(scene, options_.lights)};
    }
    void prepare(gpu::Gpu& gpu, const Scene& scene) override;
    Contribution render(gpu::Recorder& recorder, const Frame& frame) override;
    void light(gpu::Recorder& recorder, const Frame& frame, const std::vector<Capture>& captures) override;
    std::vector<std::string> warnings() const override {
        return shared_maps_warning(objects_, options_.cube.maps);
    }

protected:
    explicit CausticTechnique(const char* name) : name_(name) {}
    // Draws photons on all faces; called for each photon image.
    virtual void draw(gpu::Recorder& recorder, const Photons& photons, const DistanceCube& receivers,
                      const std::vector<CausticFace>& faces) const = 0;

    CausticOptions options_;

private:
    struct Request;
    CausticMap map_of(gpu::Recorder& recorder, const Frame& frame, const Request& request,
                      const shared::CubeObjects& objects) const;

    const char* name_; // of its passes
    std::vector<SceneObject> objects_;
    std::vector<CausticMap> maps_; // of the latest frame
};

// As cones of that radius in texels, or of the area that a power's a tells, m2, where that is larger.
void splat_photons(gpu::Recorder& recorder, const Photons& photons, const gpu::Image& powers,
                   const DistanceCube& receivers, const CausticFace& face, float radius);

} // namespace luxel
