// SPDX-License-Identifier: MIT
#include "techniques/common/blur.h"

#include <cmath>

namespace luxel {

gpu::Image blur(gpu::Recorder& recorder, const gpu::Image& from, const gpu::Image& guide,
                const Blur& settings) {
    if (settings.sigma <= 0.0f) return from;
    gpu::Image half = recorder.image(from.info(), from.name() + " blurred in x");
    gpu::Image whole = recorder.image(from.info(), from.name() + " blurred");
    shared::BlurParams params{.direction = {1, 0},
                              .radius = int(std::ceil(2.0f * settings.sigma)),
                              .sigma = settings.sigma,
                              .depth_tolerance = settings.depth_tolerance};
    recorder.dispatch("common/blur.comp", extent_of(from), params,
                      {{"guide", guide}, {"from", from}, {"to", half}});
    params.direction = {0, 1};
    recorder.dispatch("common/blur.comp", extent_of(from), params,
                      {{"guide", guide}, {"from", half}, {"to", whole}});
    return whole;
}

} // namespace luxel
