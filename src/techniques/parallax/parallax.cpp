// SPDX-License-Identifier: MIT
#include "techniques/parallax/parallax.h"

namespace luxel {

void Parallax::visit(Visitor& v) {
    v.choice("mode", mode_, {"plain", "offset_limit", "slope", "iterated"},
             "the field is taken for a plane of its height, limited, of its slope, or again and again");
    v.only_if(mode_ == ParallaxMode::iterated, "mode=iterated", [&] {
        v.integer("iterations", iterations_, {1, 64}, "corrections");
    });
    visit_depth(v);
}

std::optional<shared::HeightSearch> Parallax::height_search() const {
    return shared::HeightSearch{.parallax_steps = mode_ == ParallaxMode::iterated ? iterations_ : 1,
                                .parallax_mode = shared::uint(mode_),
                                .moves_depth = depth_ ? 1.0f : 0.0f};
}
static_assert(shared::uint(ParallaxMode::plain) == shared::PARALLAX_PLAIN &&
              shared::uint(ParallaxMode::offset_limit) == shared::PARALLAX_OFFSET_LIMIT &&
              shared::uint(ParallaxMode::slope) == shared::PARALLAX_SLOPE &&
              shared::uint(ParallaxMode::iterated) == shared::PARALLAX_ITERATED);

std::unique_ptr<Technique> make_parallax() { return std::make_unique<Parallax>(); }

} // namespace luxel
