// SPDX-License-Identifier: MIT
// Binary search of the whole depth [Umenhoffer2009, section 2.1.2].
#pragma once
#include "techniques/common/surface_technique.h"

namespace luxel {

class BinarySearch final : public SurfaceTechnique {
public:
    BinarySearch() : SurfaceTechnique(true) {}
    void visit(Visitor& v) override;
    std::optional<shared::HeightSearch> height_search() const override;

private:
    int steps_ = 8;
};

} // namespace luxel
