// SPDX-License-Identifier: MIT
// Horizon-based ambient occlusion [Bavoil2008]: open solid angle between horizons.
#pragma once
#include "techniques/common/occlusion_technique.h"
#include "techniques/hbao/hbao_params.h"

namespace luxel {

enum class HbaoFalloff { none, quadratic };

class Hbao final : public OcclusionTechnique {
public:
    void visit(Visitor& v) override;
    Contribution render(gpu::Recorder& recorder, const Frame& frame) override;

private:
    // No thickness: measured best against ray casting.
    OcclusionOptions options_{.samples = 16, .thickness = 1000.0f};
    int slices_ = 1;
    float bias_ = 0.0f; // degrees
    HbaoFalloff falloff_ = HbaoFalloff::none;
};

} // namespace luxel
