// SPDX-License-Identifier: MIT
#include "techniques/hbao/hbao.h"

#include <algorithm>
#include <cmath>

namespace luxel {

void Hbao::visit(Visitor& v) {
    options_.visit(v);
    v.integer("slices", slices_, {1, 16},
              "through the view direction; each has half of its taps on each side");
    v.real("bias", bias_, {0, 90}, "degrees above the tangent plane that horizons are ignored for");
    v.choice("falloff", falloff_, {"none", "quadratic"},
             "weight of an occluder at distance d: 1, 1 - (d/radius)^2");
}

Contribution Hbao::render(gpu::Recorder& recorder, const Frame& frame) {
    auto scope = recorder.scope("hbao");
    shared::HbaoParams p{.slices = slices_,
                         .steps = std::max(options_.samples / (2 * slices_), 1),
                         .bias = std::sin(bias_ * shared::PI / 180.0f),
                         .falloff = falloff_ == HbaoFalloff::quadratic ? 1.0f : 0.0f};
    return {.accessibility = occlusion(recorder, frame, options_, "hbao/gather.comp", p, {})};
}

std::unique_ptr<Technique> make_hbao() { return std::make_unique<Hbao>(); }

} // namespace luxel
