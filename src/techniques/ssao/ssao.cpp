// SPDX-License-Identifier: MIT
#include "techniques/ssao/ssao.h"

#include "techniques/common/point_sets.h"
#include "techniques/ssao/ssao_params.h"

namespace luxel {

Contribution Ssao::render(gpu::Recorder& recorder, const Frame& frame) {
    auto scope = recorder.scope("ssao");
    gpu::Buffer taps = taps_.upload(recorder.gpu(), options_.samples, 0, poisson_ball);
    return {.accessibility = occlusion(recorder, frame, options_, "ssao/gather.comp", shared::SsaoParams{},
                                       {{"taps", taps}})};
}

std::unique_ptr<Technique> make_ssao() { return std::make_unique<Ssao>(); }

} // namespace luxel
