// SPDX-License-Identifier: MIT
#include "techniques/secant/secant.h"

namespace luxel {

void SecantSearch::visit(Visitor& v) {
    v.integer("steps", steps_, {0, 64}, "guesses where the line between the ends' heights meets the ray");
    visit_depth(v);
}

std::optional<shared::HeightSearch> SecantSearch::height_search() const {
    return shared::HeightSearch{
        .linear_steps = 1, .secant_steps = steps_, .interpolates = 1.0f, .moves_depth = depth_ ? 1.0f : 0.0f};
}

std::unique_ptr<Technique> make_secant() { return std::make_unique<SecantSearch>(); }

} // namespace luxel
