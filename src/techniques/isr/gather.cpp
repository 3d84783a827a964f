// SPDX-License-Identifier: MIT
#include "techniques/isr/gather.h"

#include <algorithm>
#include <cmath>

#include "techniques/isr/isr.h"
#include "techniques/isr/view_params.h"

namespace luxel {

using gpu::Recorder;
using shared::IsrParams;

std::vector<glm::vec4> isr_taps(const IsrParams& p) {
    std::vector<glm::vec4> taps(std::size_t(shared::ISR_MAX_TAPS), glm::vec4(0.0f));
    if (p.mode == shared::ISR_CALIBRATED) {
        for (int i = 0; i < p.taps; ++i) {
            shared::IsrTap t = shared::log_polar_tap(i, p.taps, p.inner_radius, p.radius, 0.5f, 0.0f);
            taps[std::size_t(i)] = {t.offset, t.weight, 0.0f};
        }
        return taps;
    }
    // The thesis's square of (2k+1)^2 - 1 offsets around the pixel [Rohleder2010, listing 6]; counts in
    // between drop the outermost ones.
    int half = int(std::ceil((std::sqrt(float(p.taps + 1)) - 1.0f) / 2.0f));
    std::vector<glm::vec2> square;
    for (int y = -half; y <= half; ++y)
        for (int x = -half; x <= half; ++x)
            if (x != 0 || y != 0) square.emplace_back(float(x), float(y));
    std::stable_sort(square.begin(), square.end(),
                     [](glm::vec2 a, glm::vec2 b) { return dot(a, a) < dot(b, b); });
    for (int i = 0; i < p.taps; ++i)
        taps[std::size_t(i)] = {glm::round(square[std::size_t(i)] * p.spacing), 1.0f, 0.0f};
    return taps;
}

std::vector<IsrTable> isr_tables(gpu::Gpu& gpu, const IsrOptions& options, const IsrParams& params) {
    auto table = [&](int count, float nearest, float farthest) {
        IsrParams p = params;
        p.taps = count;
        std::vector<glm::vec4> taps = isr_taps(p);
        return IsrTable{gpu.upload(std::span<const glm::vec4>(taps), "isr taps"), count, nearest, farthest};
    };
    if (options.samples_far == 0) return {table(params.taps, params.nearest, params.farthest)};
    return {table(params.taps, params.nearest, options.far),
            table(options.samples_far, options.far, params.farthest)};
}

gpu::Image isr_gather(Recorder& recorder, const IsrSenders& senders, const gpu::Image& receiver,
                      const std::vector<IsrTable>& tables, const IsrParams& params) {
    gpu::Image irradiance = recorder.image(receiver.info(), "isr irradiance");
    IsrParams p = params;
    for (const IsrTable& table : tables) {
        p.taps = table.count, p.nearest = table.nearest, p.farthest = table.farthest;
        recorder.dispatch(p.mode == shared::ISR_THESIS ? "isr/gather_thesis.comp" : "isr/gather.comp",
                          extent_of(irradiance), p,
                          {{"taps", table.taps},
                           {"patches", senders.patches},
                           {"receiver", receiver},
                           {"source", senders.source},
                           {"irradiance", irradiance}});
    }
    return irradiance;
}

gpu::Image isr_gather_camera(Recorder& recorder, const IsrSenders& senders, const gpu::Image& receiver,
                             int taps, const IsrParams& params) {
    gpu::Image irradiance = recorder.image(receiver.info(), "isr camera irradiance");
    shared::IsrCameraParams p{.view = params.view,
                              .camera = senders.view,
                              .width = params.width,
                              .height = params.height,
                              .scale = params.scale,
                              .turn = params.turn,
                              .shift = params.shift,
                              .taps = taps};
    recorder.dispatch("isr/gather_camera.comp", extent_of(irradiance), p,
                      {{"patches", senders.patches},
                       {"source", senders.source},
                       {"receiver", receiver},
                       {"irradiance", irradiance}});
    return irradiance;
}

gpu::Image isr_reflect(Recorder& recorder, const gpu::Image& irradiance, const gpu::Image& albedo,
                       const IsrParams& params) {
    gpu::Image source = recorder.image(
        {.width = std::uint32_t(params.patches.x), .height = std::uint32_t(params.patches.y)}, "isr source");
    if (params.origin != glm::ivec2(0)) recorder.clear(source, {});
    recorder.dispatch("isr/reflect.comp", extent_of(irradiance), shared::IsrReflectParams{params.origin},
                      {{"irradiance", irradiance}, {"albedo", albedo}, {"source", source}});
    return source;
}

} // namespace luxel
