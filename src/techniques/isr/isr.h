// SPDX-License-Identifier: MIT
// Image-space radiosity [Rohleder2010]: every visible pixel is a patch that sends its direct light to the
// pixels around it.
#pragma once
#include "techniques/frame/frame.h"
#include "techniques/isr/isr_params.h"
#include "techniques/isr/temporal.h"
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

    // Beyond the frame's pixels and beyond one frame [Rohleder2010, chapter 6].
    int layers = 1;           // 2: patches behind the first surface, too
    float separation = 0.02f; // least distance between layers, as a share of depth
    float border = 0.0f;      // guard band on each side, as a share of the image
    int cameras = 0;          // further views from the eye, see isr_cameras
    int camera_samples = 64;  // taps per pixel into each of them
    int samples_far = 0;      // taps of receivers beyond `far`; 0 = samples
    float far = 10.0f;        // meters
    int temporal = 1;         // frames that are averaged at most
    void visit(Visitor& v);
};

class Isr final : public Technique {
public:
    Slot slot() const override { return Slot::diffuse; }
    std::vector<std::string> components() const override {
        return {options_.bounces > 1 ? "diffuse" : "diffuse1", "ao"};
    }
    std::vector<Need> needs(const Scene& scene, const FrameOptions& frame) const override;
    void visit(Visitor& v) override { options_.visit(v); }
    void prepare(gpu::Gpu&, const Scene&) override { history_ = {}; }
    Contribution render(gpu::Recorder& recorder, const Frame& frame) override;

private:
    IsrOptions options_;
    IsrHistory history_; // of the renderer that prepared this; empty with temporal=1
};

} // namespace luxel
