// SPDX-License-Identifier: MIT
// Secant search of the whole depth [Umenhoffer2009, section 2.1.3].
#pragma once
#include "techniques/common/surface_technique.h"

namespace luxel {

class SecantSearch final : public SurfaceTechnique {
public:
    SecantSearch() : SurfaceTechnique(true) {}
    void visit(Visitor& v) override;
    std::optional<shared::HeightSearch> height_search() const override;

private:
    int steps_ = 4;
};

} // namespace luxel
