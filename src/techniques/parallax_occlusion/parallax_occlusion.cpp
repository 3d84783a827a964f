// SPDX-License-Identifier: MIT
#include "techniques/parallax_occlusion/parallax_occlusion.h"

namespace luxel {

void ParallaxOcclusion::visit(Visitor& v) {
    v.integer("steps", steps_, {1, 1024}, "equal steps of the linear search");
    v.integer("refine", refine_, {0, 24},
              "secant steps after it; without any the relief is linear in a step");
    visit_depth(v);
}

std::optional<shared::HeightSearch> ParallaxOcclusion::height_search() const {
    return shared::HeightSearch{.linear_steps = steps_,
                                .secant_steps = refine_,
                                .interpolates = 1.0f,
                                .moves_depth = depth_ ? 1.0f : 0.0f};
}

std::unique_ptr<Technique> make_parallax_occlusion() { return std::make_unique<ParallaxOcclusion>(); }

} // namespace luxel
