// SPDX-License-Identifier: MIT
// Diffuse environment mapping [Umenhoffer2009, chapter 3]: what surrounds an object, seen from its center and
// reduced to a few dozen quadrilaterals, lights each of its points.
#pragma once
#include "techniques/frame/frame.h"
#include "techniques/technique.h"

namespace luxel {

enum class EnvmapEstimator { classic, point, disc, polygon };
enum class EnvmapHorizon { clip, clamp_sum, thesis };
enum class EnvmapCorner { exact, averaged };
enum class EnvmapRadiance { texel, corners };
enum class EnvmapProbes { objects, grid };
enum class EnvmapLight { bounce, all };

struct EnvmapOptions {
    EnvmapEstimator estimator = EnvmapEstimator::polygon;
    EnvmapHorizon horizon = EnvmapHorizon::clip;
    EnvmapCorner corner = EnvmapCorner::exact;
    EnvmapRadiance radiance = EnvmapRadiance::texel;
    EnvmapLight light = EnvmapLight::bounce;
    int texels = 4; // M: a side of a face, 2, 4 or 8
    int size = 128; // of the captured cube
    EnvmapProbes probes = EnvmapProbes::objects;
    bool glossy = false;
    int grid = 4; // probes along the scene's longest side, probes=grid only
    bool occlusion = false;
    void visit(Visitor& v);
};

class Envmap final : public Technique {
public:
    Slot slot() const override { return Slot::diffuse; }
    Receivers receivers() const override {
        return options_.probes == EnvmapProbes::grid ? Receivers::all : Receivers::dynamic_objects;
    }
    bool takes_parallel_views() const override { return true; }
    std::vector<std::string> components() const override;
    std::vector<Need> needs(const Scene& scene, const FrameOptions& frame) const override;
    void visit(Visitor& v) override { options_.visit(v); }
    void prepare(gpu::Gpu& gpu, const Scene& scene) override;
    Contribution render(gpu::Recorder& recorder, const Frame& frame) override;

private:
    EnvmapOptions options_;
    gpu::Image reflectance_; // with options_.glossy
};

} // namespace luxel
