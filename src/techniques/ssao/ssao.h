// SPDX-License-Identifier: MIT
// Screen-space ambient occlusion as Crytek made it [Mittring2007]: the baseline of the occlusion slot.
#pragma once
#include "techniques/common/occlusion_technique.h"

namespace luxel {

class Ssao final : public OcclusionTechnique {
public:
    void visit(Visitor& v) override { options_.visit(v); }
    Contribution render(gpu::Recorder& recorder, const Frame& frame) override;

private:
    OcclusionOptions options_;
    TapTable taps_;
};

} // namespace luxel
