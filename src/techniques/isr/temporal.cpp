// SPDX-License-Identifier: MIT
#include "techniques/isr/temporal.h"

#include "techniques/isr/view_params.h"

namespace luxel {

glm::vec2 isr_frame_jitter(const IsrHistory& history) {
    // The sequence repeats before its index loses bits to the factor.
    return shared::isr_even_point(history.frames % 4096, 0.0f, 0.0f);
}

gpu::Image isr_accumulate(gpu::Recorder& recorder, const gpu::Image& irradiance, const gpu::Image& guide,
                          const shared::IsrParams& params, int length, IsrHistory& history) {
    gpu::ImageInfo scalar{.width = params.width, .height = params.height, .format = VK_FORMAT_R32_SFLOAT};
    gpu::Image mean = irradiance, mean_length = recorder.image(scalar, "isr history length");
    bool usable = history.irradiance && history.irradiance.width() == params.width &&
                  history.irradiance.height() == params.height;
    if (usable) {
        mean = recorder.image(irradiance.info(), "isr irradiance accumulated");
        // A surface is found again when it lies within half a percent of its depth of the plane, turned by
        // less than 26 degrees.
        shared::IsrTemporalParams p{.view = params.view,
                                    .before = history.view,
                                    .scale = params.scale,
                                    .frames = float(length),
                                    .tolerance = 0.005f,
                                    .least_cos = 0.9f};
        recorder.dispatch("isr/temporal.comp", extent_of(mean), p,
                          {{"irradiance", irradiance},
                           {"guide", guide},
                           {"history", history.irradiance},
                           {"history_guide", history.guide},
                           {"history_length", history.length},
                           {"mean", mean},
                           {"mean_length", mean_length}});
    } else {
        recorder.clear(mean_length, {1.0f});
    }
    history = {mean, guide, mean_length, params.view, history.frames + 1};
    return mean;
}

} // namespace luxel
