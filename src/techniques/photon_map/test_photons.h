// SPDX-License-Identifier: MIT
// The photons of a frame, as the technique makes them.
#pragma once
#include <vector>

#include "techniques/frame/renderer.h"
#include "techniques/photon_map/photon_map.h"

namespace luxel {

// Makes photons, and nothing to see.
class PhotonProbe final : public Technique {
public:
    explicit PhotonProbe(const PhotonOptions& options) : options_(options) {}
    Slot slot() const override { return Slot::caustics; }
    void prepare(gpu::Gpu& gpu, const Scene& scene) override { lists_ = FragmentLists(gpu, scene); }
    Contribution render(gpu::Recorder& recorder, const Frame& frame) override {
        capture_lists(recorder, lists_, *frame.scene, list_projection(frame, options_), options_);
        photons_ = emit_photons(recorder, reflective_shadow_maps(recorder, frame, options_.rsm),
                                lists_.view().center, options_);
        follow_photons(recorder, lists_, photons_, options_);
        return {};
    }
    // In world space.
    std::vector<shared::Photon> read(gpu::Gpu& gpu) const {
        std::vector<shared::Photon> all = gpu.read_all<shared::Photon>(photons_.photons);
        all.resize(std::min<std::size_t>(all.size(), gpu.read_all<shared::uint>(photons_.counts)[0]));
        for (shared::Photon& p : all) p.position += lists_.view().center;
        return all;
    }

private:
    PhotonOptions options_;
    FragmentLists lists_;
    PhotonBuffers photons_;
};

inline std::vector<shared::Photon> photons_of(gpu::Gpu& gpu, const Scene& scene,
                                              const PhotonOptions& options) {
    FrameOptions plain;
    plain.emitter_lights = 0, plain.environment = EnvironmentMode::none, plain.shadow_size = 64;
    PhotonProbe probe(options);
    Renderer(gpu, scene, plain)
        .render({.camera = scene.cameras.front(), .width = 64, .height = 64, .techniques = {&probe}});
    return probe.read(gpu);
}

} // namespace luxel
