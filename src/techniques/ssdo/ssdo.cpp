// SPDX-License-Identifier: MIT
#include "techniques/ssdo/ssdo.h"

#include "techniques/common/blur.h"
#include "techniques/common/light_samples.h"
#include "techniques/ssdo/compose_params.h"

namespace luxel {

using gpu::Recorder;
using shared::SsdoParams;

void SsdoOptions::visit(Visitor& v) {
    v.choice("mode", mode, {"physical", "paper"},
             "physical: rays with the light of what they meet; paper: one point a direction, senders of "
             "equal area");
    v.real("radius", radius, {0.001, 1000}, "meters within which surfaces send light and block ambient");
    v.integer("samples", samples, {1, 1024}, "directions per pixel");
    v.only_if(mode == SsdoMode::physical, "mode=physical", [&] {
        v.integer("steps", steps, {1, 256}, "points along each direction");
        v.real("thickness", thickness, {0, 1e6},
               "how far occluders reach behind what is seen, over their distance");
    });
    v.choice("resolution", resolution, {"half", "full"}, "of the gathered image");
    v.real("blur", blur, {0, 16}, "Gaussian sigma in gathered pixels; 0 = none");
}

namespace {

SsdoParams make_params(const SsdoOptions& options, const Frame& frame) {
    std::uint32_t step = options.resolution == SsdoResolution::half ? 2 : 1;
    return {.view = frame.view,
            .environment = frame.ambient_sh,
            .width = (frame.width + step - 1) / step,
            .height = (frame.height + step - 1) / step,
            .scale = int(step),
            .samples = options.samples,
            .steps = options.steps,
            .radius = options.radius,
            .thickness = options.thickness};
}

// The images that are gathered from, and at whose pixels.
struct Gathered {
    gpu::Image surface, receiver, source;
};

Gathered sample_frame(Recorder& recorder, const Frame& frame, const SsdoParams& p) {
    gpu::ImageInfo info{.width = p.width, .height = p.height};
    Gathered s{.surface = recorder.image(info, "ssdo surface"),
               .receiver = recorder.image(info, "ssdo receiver"),
               .source = recorder.image(info, "ssdo source")};
    recorder.dispatch("ssdo/prepare.comp", extent_of(s.surface), p,
                      {{"depth", frame.gbuffer.depth},
                       {"geometric_normal", frame.gbuffer.geometric_normal},
                       {"normal", frame.gbuffer.normal},
                       {"direct_diffuse", frame.direct_diffuse},
                       {"surface", s.surface},
                       {"receiver", s.receiver},
                       {"source", s.source}});
    return s;
}

gpu::Image gather(Recorder& recorder, const Gathered& s, const SsdoParams& p, SsdoMode mode) {
    gpu::Image irradiance = recorder.image(s.surface.info(), "ssdo irradiance");
    recorder.dispatch(
        mode == SsdoMode::paper ? "ssdo/gather_paper.comp" : "ssdo/gather.comp", extent_of(irradiance), p,
        {{"surface", s.surface}, {"receiver", s.receiver}, {"source", s.source}, {"irradiance", irradiance}});
    return irradiance;
}

Contribution compose(Recorder& recorder, const Frame& frame, const gpu::Image& irradiance,
                     const gpu::Image& receiver, float scale) {
    gpu::ImageInfo info{.width = frame.width, .height = frame.height};
    Contribution c;
    c.radiance = recorder.image(info, "ssdo radiance");
    info.format = VK_FORMAT_R32_SFLOAT;
    c.accessibility = recorder.image(info, "ssdo accessibility");
    recorder.dispatch("ssdo/compose.comp", extent_of(c.radiance), shared::SsdoComposeParams{.scale = scale},
                      {{"irradiance", irradiance},
                       {"receiver", receiver},
                       {"depth", frame.gbuffer.depth},
                       {"normal", frame.gbuffer.normal},
                       {"diffuse", frame.gbuffer.diffuse},
                       {"ambient", frame.ambient},
                       {"radiance", c.radiance},
                       {"accessibility", c.accessibility}});
    return c;
}

} // namespace

std::vector<Need> Ssdo::needs(const Scene& scene, const FrameOptions& frame) const {
    const Need light = light_need(scene, frame);
    return {{light.what, light.met || has_ambient_light(scene, frame)}};
}

Contribution Ssdo::render(Recorder& recorder, const Frame& frame) {
    auto scope = recorder.scope("ssdo");
    SsdoParams p = make_params(options_, frame);
    Gathered s = sample_frame(recorder, frame, p);
    gpu::Image irradiance = blur(recorder, gather(recorder, s, p, options_.mode), s.receiver,
                                 {.sigma = options_.blur, .depth_tolerance = 0.01f});
    return compose(recorder, frame, irradiance, s.receiver, float(p.scale));
}

std::unique_ptr<Technique> make_ssdo() { return std::make_unique<Ssdo>(); }

} // namespace luxel
