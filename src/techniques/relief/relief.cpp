// SPDX-License-Identifier: MIT
#include "techniques/relief/relief.h"

namespace luxel {

void Relief::visit(Visitor& v) {
    v.integer("steps", steps_, {1, 1024}, "equal steps of the linear search");
    v.integer("refine", refine_, {0, 24}, "halvings of the step that ends below the relief");
    visit_depth(v);
}

std::optional<shared::HeightSearch> Relief::height_search() const {
    return shared::HeightSearch{
        .linear_steps = steps_, .binary_steps = refine_, .moves_depth = depth_ ? 1.0f : 0.0f};
}

std::unique_ptr<Technique> make_relief() { return std::make_unique<Relief>(); }

} // namespace luxel
