// SPDX-License-Identifier: MIT
// Parallax occlusion mapping [Umenhoffer2009, section 2.1.5]: linear, then secant search.
#pragma once
#include "techniques/common/surface_technique.h"

namespace luxel {

class ParallaxOcclusion final : public SurfaceTechnique {
public:
    ParallaxOcclusion() : SurfaceTechnique(true) {}
    void visit(Visitor& v) override;
    std::optional<shared::HeightSearch> height_search() const override;

private:
    int steps_ = 16, refine_ = 1;
};

} // namespace luxel
