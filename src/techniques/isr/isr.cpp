// SPDX-License-Identifier: MIT
#include "techniques/isr/isr.h"

#include "core/error.h"
#include "techniques/common/blur.h"
#include "techniques/common/light_samples.h"
#include "techniques/isr/compose_params.h"
#include "techniques/isr/gather.h"
#include "techniques/isr/patches.h"

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
    v.only_if(mode == IsrMode::thesis, "mode=thesis", [&] {
        v.real("spacing", spacing, {1, 64}, "coarse pixels between the offsets");
        v.real("k_isr", k_isr, {0, 10}, "indirect power");
        v.real("k_ssao", k_ssao, {0, 1}, "occlusion power");
    });
    v.integer("layers", layers, {1, 2}, "2: patches that the first surface hides send light, too");
    v.only_if(layers > 1, "layers=2", [&] {
        v.real("separation", separation, {0.0001, 1}, "least distance between layers as a share of depth");
    });
    v.real("border", border, {0, 1}, "guard band on each side as a share of the image");
    v.integer("cameras", cameras, {0, 5}, "further views from the eye: back, left, right, up, down");
    v.only_if(cameras > 0, "cameras above 0", [&] {
        v.integer("camera_samples", camera_samples, {1, 4096}, "taps per pixel into each further view");
    });
    v.integer("samples_far", samples_far, {0, double(shared::ISR_MAX_TAPS)},
              "taps per pixel beyond `far`; 0 = as many as before it");
    v.only_if(samples_far > 0, "samples_far above 0", [&] {
        v.real("far", far, {0.001, 100000}, "meters from which on samples_far counts");
    });
    v.integer("temporal", temporal, {1, 4096}, "frames that are averaged at most; 1 = none but the present");
}

namespace {

// sum += bounce, with the accessibility that the sum has.
void add(Recorder& recorder, const gpu::Image& bounce, const gpu::Image& sum) {
    recorder.dispatch("frame/add.comp", extent_of(sum), Recorder::NoParams{},
                      {{"contribution", bounce}, {"radiance", sum}});
}

// The first bounce from everything that is directly lit.
gpu::Image gather_all(Recorder& recorder, const IsrPatches& patches, const std::vector<IsrTable>& tables,
                      int camera_samples, const IsrParams& p) {
    gpu::Image sum = isr_gather(recorder, patches.visible, patches.receiver, tables, p);
    if (patches.hidden.patches)
        add(recorder, isr_gather(recorder, patches.hidden, patches.receiver, tables, p), sum);
    for (const IsrSenders& camera : patches.cameras)
        add(recorder, isr_gather_camera(recorder, camera, patches.receiver, camera_samples, p), sum);
    return sum;
}

Contribution compose(Recorder& recorder, const Frame& frame, const IsrOptions& options,
                     const gpu::Image& irradiance, const gpu::Image& guide) {
    shared::IsrComposeParams p{.scale = options.resolution == IsrResolution::half ? 2.0f : 1.0f,
                               .mode = options.mode == IsrMode::thesis ? shared::ISR_THESIS
                                                                       : shared::ISR_CALIBRATED,
                               .k_isr = options.k_isr,
                               .k_ssao = options.k_ssao};
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

} // namespace

std::vector<Need> Isr::needs(const Scene& scene, const FrameOptions& frame) const {
    const Need light = light_need(scene, frame);
    return {{light.what, light.met || has_ambient_light(scene, frame)}};
}

Contribution Isr::render(Recorder& recorder, const Frame& frame) {
    auto scope = recorder.scope("isr");
    if (options_.mode == IsrMode::thesis && options_.cameras > 0)
        fail(Fault::usage, "isr: cameras={}: further views are for mode=calibrated only", options_.cameras);
    IsrParams p = isr_params(options_, frame);
    if (options_.temporal > 1) {
        glm::vec2 jitter = isr_frame_jitter(history_);
        p.turn = jitter.x, p.shift = jitter.y;
    }
    std::vector<IsrTable> tables = isr_tables(recorder.gpu(), options_, p);

    // First bounce from directly lit patches; each further bounce from the one before, between what the
    // frame shows.
    Blur filter{.sigma = options_.blur, .depth_tolerance = options_.mode == IsrMode::thesis ? 0.0f : 0.01f};
    IsrPatches patches = isr_patches(recorder, frame, options_, p);
    gpu::Image bounce = blur(recorder, gather_all(recorder, patches, tables, options_.camera_samples, p),
                             patches.receiver, filter);
    gpu::Image irradiance = bounce;
    for (int i = 1; i < options_.bounces; ++i) {
        patches.visible.source = isr_reflect(recorder, bounce, patches.albedo, p);
        bounce = blur(recorder, isr_gather(recorder, patches.visible, patches.receiver, tables, p),
                      patches.receiver, filter);
        add(recorder, bounce, irradiance);
    }
    if (options_.temporal > 1)
        irradiance = isr_accumulate(recorder, irradiance, patches.receiver, p, options_.temporal, history_);
    return compose(recorder, frame, options_, irradiance, patches.receiver);
}

std::unique_ptr<Technique> make_isr() { return std::make_unique<Isr>(); }

} // namespace luxel
