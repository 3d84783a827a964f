// SPDX-License-Identifier: MIT
#include "techniques/binary/binary.h"

namespace luxel {

void BinarySearch::visit(Visitor& v) {
    v.integer("steps", steps_, {0, 24}, "halvings of the depth");
    visit_depth(v);
}

std::optional<shared::HeightSearch> BinarySearch::height_search() const {
    return shared::HeightSearch{
        .linear_steps = 1, .binary_steps = steps_, .moves_depth = depth_ ? 1.0f : 0.0f};
}

std::unique_ptr<Technique> make_binary() { return std::make_unique<BinarySearch>(); }

} // namespace luxel
