// SPDX-License-Identifier: MIT
// Volumetric ambient occlusion [Umenhoffer2009, chapter 4]: the open share of the tangent sphere.
#pragma once
#include "techniques/common/occlusion_technique.h"

namespace luxel {

enum class VolumetricNormalization { wis, analytic };

class Volumetric final : public OcclusionTechnique {
public:
    void visit(Visitor& v) override;
    Contribution render(gpu::Recorder& recorder, const Frame& frame) override;

private:
    OcclusionOptions options_;
    VolumetricNormalization normalization_ = VolumetricNormalization::wis;
    TapTable taps_;
};

} // namespace luxel
