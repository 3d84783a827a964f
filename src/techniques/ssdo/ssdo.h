// SPDX-License-Identifier: MIT
// Screen-space directional occlusion [Ritschel2009]: what hides the environment from a pixel sends it its own
// light instead.
#pragma once
#include "techniques/frame/frame.h"
#include "techniques/ssdo/ssdo_params.h"
#include "techniques/technique.h"

namespace luxel {

enum class SsdoMode { physical, paper };
enum class SsdoResolution { half, full };

struct SsdoOptions {
    SsdoMode mode = SsdoMode::physical;
    float radius = 8.0f; // meters
    int samples = 8;
    int steps = 16;
    float thickness = 0.4f;
    SsdoResolution resolution = SsdoResolution::half;
    float blur = 2.0f; // Gaussian sigma, gathered pixels
    void visit(Visitor& v);
};

class Ssdo final : public Technique {
public:
    Slot slot() const override { return Slot::diffuse; }
    std::vector<std::string> components() const override { return {"diffuse1", "ao"}; }
    std::vector<Need> needs(const Scene& scene, const FrameOptions& frame) const override;
    void visit(Visitor& v) override { options_.visit(v); }
    Contribution render(gpu::Recorder& recorder, const Frame& frame) override;

private:
    SsdoOptions options_;
};

} // namespace luxel
