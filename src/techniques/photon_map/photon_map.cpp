// SPDX-License-Identifier: MIT
// The frame of the technique, and its options.
#include "techniques/photon_map/photon_map.h"

#include "scene/roles.h"

namespace luxel {

void PhotonOptions::visit(Visitor& v) {
    v.integer("photons", photons, {1, 1 << 19}, "most of them; glass sends two for each");
    v.choice(
        "capture", capture, {"camera", "box"},
        "where photons are traced: in what the camera can see and a margin, or in a box around the scene");
    v.only_if(capture == PhotonCapture::camera, "capture=camera", [&] {
        v.real("margin", margin, {0, 4},
               "of the camera's capture on each side, as a share of its half width");
    });
    v.integer("resolution", side, {16, 1024},
              "pixels a side of the lists; a power of two can be skipped over best");
    v.choice("tracer", tracer, {"march", "lines", "layers"},
             "a walk over the pixels that a ray crosses, rays drawn as lines, or a walk over peeled layers");
    v.only_if(tracer == PhotonTracer::layers, "tracer=layers", [&] {
        v.integer("layers", layers, {1, 64}, "that are peeled");
    });
    v.only_if(tracer != PhotonTracer::lines, "tracer=march or layers",
              [&] { v.flag("skip", skip, "over empty space by a min-max pyramid"); });
    v.integer("bounces", bounces, {1, 16}, "specular surfaces on a photon's path");
    v.flag("both", both, "glass met first reflects and refracts; else one of them by chance");
    v.flag("mixed", mixed, "cells of the shadow map that are specular in part send photons, too");
    v.choice("kernel", kernel, photon_kernels, "of a photon's disc");
    v.choice(
        "disc", disc, {"beam", "differential"},
        "a photon's disc is as wide as its part of the beam were unfocused, or as its neighbors' rays say");
    v.real("share", share, {0.1, 1000}, "photons that a disc holds, but for tents that reach the next ones");
    v.integer("scale", scale, {1, 8}, "pixels a side of the frame for each that photons are splatted on");
    rsm.visit(v);
}

ListProjection list_projection(const Frame& frame, const PhotonOptions& options) {
    const Bounds bounds = frame.scene->bounds();
    if (options.capture == PhotonCapture::box) return list_view_of_box(bounds, options.side);
    return list_view_of_camera(frame.view, bounds, options.side, options.margin);
}

void capture_lists(gpu::Recorder& recorder, FragmentLists& lists, const GpuScene& scene,
                   const ListProjection& projection, const PhotonOptions& options) {
    if (options.tracer == PhotonTracer::layers)
        lists.capture_layers(recorder, scene, projection, options.layers);
    else
        lists.capture(recorder, scene, projection);
}

namespace {

class PhotonMapTechnique final : public Technique {
public:
    Slot slot() const override { return Slot::caustics; }
    std::vector<std::string> components() const override { return {"caustics"}; }
    std::vector<Need> needs(const Scene& scene, const FrameOptions&) const override {
        return {{"a mirror, smooth metal or glass", has_specular_surface(scene)},
                light_need(scene, options_.rsm.lights)};
    }
    void visit(Visitor& v) override { options_.visit(v); }
    void prepare(gpu::Gpu& gpu, const Scene& scene) override { lists_ = FragmentLists(gpu, scene); }

    Contribution render(gpu::Recorder& recorder, const Frame& frame) override {
        auto scope = recorder.scope("photon_map");
        capture_lists(recorder, lists_, *frame.scene, list_projection(frame, options_), options_);
        const std::vector<RsmView> views = reflective_shadow_maps(recorder, frame, options_.rsm);
        photons_ = emit_photons(recorder, views, lists_.view().center, options_);
        follow_photons(recorder, lists_, photons_, options_);
        return {.radiance = radiance_of(recorder, frame)};
    }
    void light(gpu::Recorder& recorder, const Frame&, const std::vector<Capture>& captures) override {
        auto scope = recorder.scope("photon_map");
        for (const Capture& seen : captures)
            recorder.dispatch("frame/add.comp", extent_of(seen.direct), gpu::Recorder::NoParams{},
                              {{"contribution", radiance_of(recorder, seen)}, {"radiance", seen.direct}});
    }

private:
    // What the photons light of a view's surfaces.
    gpu::Image radiance_of(gpu::Recorder& recorder, const Capture& seen) const {
        const gpu::Image irradiance =
            photon_irradiance(recorder, seen, photons_, lists_.view().center, options_);
        gpu::Image radiance = recorder.image({.width = seen.width, .height = seen.height}, "caustics");
        recorder.dispatch(
            "common/reflect.comp", extent_of(radiance), gpu::Recorder::NoParams{},
            {{"diffuse", seen.gbuffer.diffuse}, {"irradiance", irradiance}, {"radiance", radiance}});
        return radiance;
    }

    PhotonOptions options_;
    FragmentLists lists_;
    PhotonBuffers photons_; // of the latest frame
};

} // namespace

std::unique_ptr<Technique> make_photon_map() { return std::make_unique<PhotonMapTechnique>(); }

} // namespace luxel
