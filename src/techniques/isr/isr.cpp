// SPDX-License-Identifier: MIT
#include "techniques/isr/isr.h"

#include <algorithm>
#include <cmath>

#include "techniques/common/blur.h"
#include "techniques/isr/compose_params.h"

namespace luxel {

using gpu::Recorder;
using shared::IsrParams;

void IsrOptions::visit(Visitor& v) {
    v.choice("mode", mode, {"calibrated", "thesis"},
             "calibrated: physical estimate; thesis: the sums of the thesis, unlit colors and k = .5");
    v.integer("samples", samples, {1, double(shared::ISR_MAX_TAPS)}, "taps per pixel");
    v.choice("resolution", resolution, {"half", "full"}, "size of the buffers that are gathered from");
    v.real("radius", radius, {0.005, 4}, "kernel radius as a share of the image height");
    v.integer("bounces", bounces, {1, 16}, "diffuse bounces; each repeats the gather");
    v.real("blur", blur, {0, 16}, "Gaussian sigma in coarse pixels; 0 = none");
    v.real("grazing", grazing, {0.001, 1}, "least cosine between a patch and the view ray");
    v.real("ao_radius", ao_radius, {0.001, 1000}, "meters within which patches block ambient light");
    v.real("spacing", spacing, {1, 64}, "coarse pixels between the offsets, mode=thesis only");
    v.real("k_isr", k_isr, {0, 10}, "indirect power, mode=thesis only");
    v.real("k_ssao", k_ssao, {0, 1}, "occlusion power, mode=thesis only");
}

namespace {

// The coarse buffers of one frame.
struct Coarse {
    gpu::Image patches, receiver, source, albedo;
};

IsrParams make_params(const IsrOptions& options, const Frame& frame) {
    std::uint32_t step = options.resolution == IsrResolution::half ? 2 : 1;
    IsrParams p{};
    p.view = frame.view;
    p.width = (frame.width + step - 1) / step;
    p.height = (frame.height + step - 1) / step;
    p.scale = float(step);
    // The image plane at distance 1 is 2|right| by 2|up| meters.
    float plane = 4.0f * glm::length(frame.view.right) * glm::length(frame.view.up);
    p.pixel_area = plane / float(frame.width * frame.height) * float(step * step);
    p.mode = options.mode == IsrMode::thesis ? shared::ISR_THESIS : shared::ISR_CALIBRATED;
    p.taps = options.samples;
    p.radius = std::max(options.radius * float(frame.height) / p.scale, 2.0f);
    p.inner_radius = 0.5f;
    p.grazing = options.grazing;
    p.ao_radius = options.ao_radius;
    // The thesis states neither its spacing nor its spheres: occlusion uses half the spacing of radiosity,
    // with spheres that touch each other.
    p.spacing = options.spacing;
    p.ao_stride = 0.5f;
    p.occluder = 0.5f * p.ao_stride * p.spacing;
    return p;
}

Coarse downsample(Recorder& recorder, const Frame& frame, const IsrParams& p) {
    gpu::ImageInfo info{.width = p.width, .height = p.height};
    Coarse c{.patches = recorder.image(info, "isr patches"),
             .receiver = recorder.image(info, "isr receiver"),
             .source = recorder.image(info, "isr source"),
             .albedo = recorder.image(info, "isr albedo")};
    const GBuffer& g = frame.gbuffer;
    recorder.dispatch("isr/downsample.comp", extent_of(c.patches), p,
                      {{"depth", g.depth},
                       {"geometric_normal", g.geometric_normal},
                       {"normal", g.normal},
                       {"diffuse", g.diffuse},
                       {"direct_diffuse", frame.direct_diffuse},
                       {"patches", c.patches},
                       {"receiver", c.receiver},
                       {"source", c.source},
                       {"albedo", c.albedo}});
    return c;
}

gpu::Image gather(Recorder& recorder, const Coarse& coarse, const gpu::Buffer& taps, const IsrParams& p) {
    gpu::Image irradiance = recorder.image(coarse.patches.info(), "isr irradiance");
    recorder.dispatch("isr/gather.comp", extent_of(irradiance), p,
                      {{"taps", taps},
                       {"patches", coarse.patches},
                       {"receiver", coarse.receiver},
                       {"source", coarse.source},
                       {"irradiance", irradiance}});
    return irradiance;
}

// What a bounce's irradiance sends on: albedo/pi E.
gpu::Image reflect(Recorder& recorder, const gpu::Image& irradiance, const gpu::Image& albedo) {
    gpu::Image source = recorder.image(irradiance.info(), "isr source");
    recorder.dispatch("isr/reflect.comp", extent_of(source), Recorder::NoParams{},
                      {{"irradiance", irradiance}, {"albedo", albedo}, {"source", source}});
    return source;
}

// sum += bounce, with the accessibility that the sum has.
void add(Recorder& recorder, const gpu::Image& bounce, const gpu::Image& sum) {
    recorder.dispatch("frame/add.comp", extent_of(sum), Recorder::NoParams{},
                      {{"contribution", bounce}, {"radiance", sum}});
}

} // namespace

Contribution Isr::compose(Recorder& recorder, const Frame& frame, const gpu::Image& irradiance,
                          const gpu::Image& guide) const {
    shared::IsrComposeParams p{.scale = options_.resolution == IsrResolution::half ? 2.0f : 1.0f,
                               .mode = options_.mode == IsrMode::thesis ? shared::ISR_THESIS
                                                                        : shared::ISR_CALIBRATED,
                               .k_isr = options_.k_isr,
                               .k_ssao = options_.k_ssao};
    Contribution c{.radiance = recorder.image({.width = frame.width, .height = frame.height}, "isr radiance"),
                   .accessibility = recorder.image(
                       {.width = frame.width, .height = frame.height, .format = VK_FORMAT_R32_SFLOAT},
                       "isr accessibility")};
    recorder.dispatch("isr/compose.comp", extent_of(c.radiance), p,
                      {{"irradiance", irradiance},
                       {"guide", guide},
                       {"depth", frame.gbuffer.depth},
                       {"normal", frame.gbuffer.normal},
                       {"diffuse", frame.gbuffer.diffuse},
                       {"direct", frame.direct},
                       {"radiance", c.radiance},
                       {"accessibility", c.accessibility}});
    return c;
}

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

Contribution Isr::render(Recorder& recorder, const Frame& frame) {
    auto scope = recorder.scope("isr");
    IsrParams p = make_params(options_, frame);
    std::vector<glm::vec4> table = isr_taps(p);
    gpu::Buffer taps = recorder.gpu().upload(std::span<const glm::vec4>(table), "isr taps");

    // First bounce from directly lit patches; each further bounce from the one before.
    Blur filter{.sigma = options_.blur, .depth_tolerance = options_.mode == IsrMode::thesis ? 0.0f : 0.01f};
    Coarse coarse = downsample(recorder, frame, p);
    gpu::Image bounce = blur(recorder, gather(recorder, coarse, taps, p), coarse.receiver, filter);
    gpu::Image irradiance = bounce;
    for (int i = 1; i < options_.bounces; ++i) {
        coarse.source = reflect(recorder, bounce, coarse.albedo);
        bounce = blur(recorder, gather(recorder, coarse, taps, p), coarse.receiver, filter);
        add(recorder, bounce, irradiance);
    }
    return compose(recorder, frame, irradiance, coarse.receiver);
}

std::unique_ptr<Technique> make_isr() { return std::make_unique<Isr>(); }

} // namespace luxel
