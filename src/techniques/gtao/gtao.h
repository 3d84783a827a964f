// SPDX-License-Identifier: MIT
// Ground-truth ambient occlusion [Jimenez2016]: cosine-weighted openness between horizons.
#pragma once
#include "techniques/common/occlusion_technique.h"
#include "techniques/gtao/gtao_params.h"

namespace luxel {

class Gtao final : public OcclusionTechnique {
public:
    void visit(Visitor& v) override;
    Contribution render(gpu::Recorder& recorder, const Frame& frame) override;

private:
    // No thickness: measured best against ray casting.
    OcclusionOptions options_{.samples = 16, .thickness = 1000.0f};
    int slices_ = 1;
    bool bent_normals_ = false;
};

} // namespace luxel
