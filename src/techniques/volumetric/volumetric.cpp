// SPDX-License-Identifier: MIT
#include "techniques/volumetric/volumetric.h"

#include "techniques/common/point_sets.h"
#include "techniques/volumetric/volumetric_params.h"

namespace luxel {

void Volumetric::visit(Visitor& v) {
    options_.visit(v);
    v.choice("normalization", normalization_, {"wis", "analytic"},
             "divide by the volume that the taps find, or by the sphere's");
}

Contribution Volumetric::render(gpu::Recorder& recorder, const Frame& frame) {
    auto scope = recorder.scope("volumetric");
    shared::VolumetricParams p{.analytic = normalization_ == VolumetricNormalization::analytic};
    gpu::Buffer taps = taps_.upload(recorder.gpu(), options_.samples, 0, poisson_disc);
    return {.accessibility =
                occlusion(recorder, frame, options_, "volumetric/gather.comp", p, {{"taps", taps}})};
}

std::unique_ptr<Technique> make_volumetric() { return std::make_unique<Volumetric>(); }

} // namespace luxel
