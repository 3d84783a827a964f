// SPDX-License-Identifier: MIT
// Image-space radiosity [Rohleder2010]: every visible pixel is a patch that sends its direct light to the
// pixels around it.
#pragma once
#include "techniques/frame/frame.h"
#include "techniques/isr/isr_params.h"
#include "techniques/technique.h"

namespace luxel {

enum class IsrMode { calibrated, thesis }; // the values of ISR_*
enum class IsrResolution { half, full };

struct IsrOptions {
    IsrMode mode = IsrMode::calibrated;
    int samples = 80;
    IsrResolution resolution = IsrResolution::half;
    float radius = 1.0f; // of the kernel, as a share of the image height
    int bounces = 1;
    float blur = 3.0f;                 // Gaussian sigma, coarse pixels
    float grazing = 0.05f;             // least cosine between a patch and the view ray
    float ao_radius = 1.0f;            // meters
    float spacing = 4.0f;              // coarse pixels, mode=thesis only
    float k_isr = 0.5f, k_ssao = 0.5f; // mode=thesis only
    void visit(Visitor& v);
};

class Isr final : public Technique {
public:
    Slot slot() const override { return Slot::diffuse; }
    void visit(Visitor& v) override { options_.visit(v); }
    Contribution render(gpu::Recorder& recorder, const Frame& frame) override;

private:
    Contribution compose(gpu::Recorder& recorder, const Frame& frame, const gpu::Image& irradiance,
                         const gpu::Image& guide) const;
    IsrOptions options_;
};

// Tap table of one mode: xy = offset, z = weight in coarse pixels; ISR_MAX_TAPS entries, the first `count` in
// use.
std::vector<glm::vec4> isr_taps(const shared::IsrParams& params);

} // namespace luxel
