// SPDX-License-Identifier: MIT
// Relief mapping [Umenhoffer2009, section 2.1.5]: linear, then binary search.
#pragma once
#include "techniques/common/surface_technique.h"

namespace luxel {

class Relief final : public SurfaceTechnique {
public:
    Relief() : SurfaceTechnique(true) {}
    void visit(Visitor& v) override;
    std::optional<shared::HeightSearch> height_search() const override;

private:
    int steps_ = 16, refine_ = 6;
};

} // namespace luxel
