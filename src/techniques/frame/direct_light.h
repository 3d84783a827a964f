// SPDX-License-Identifier: MIT
// Direct light of any number of lights in bounded memory: batches of lights share one array of shadow maps.
#pragma once
#include <vector>

#include "gpu/recorder.h"
#include "techniques/frame/frame.h"
#include "techniques/frame/shadow_maps.h"

namespace luxel {

struct FrameLight {
    shared::Light light;
    int map_size; // texels a side of each of its maps
};

// The scene's lights, samples of its emitters and, for EnvironmentMode::lights, of its environment, grouped
// by map size.
std::vector<FrameLight> frame_lights(const Scene& scene, const FrameOptions& options);

// Adds the lights to direct and direct_diffuse of captures.
class DirectLight {
public:
    DirectLight(gpu::Gpu& gpu, const Scene& scene, const FrameOptions& options);
    // Each shadow map is drawn once for all captures, which are of one scene.
    void render(gpu::Recorder& recorder, const std::vector<Capture>& captures) const;
    std::size_t light_count() const { return lights_.size(); }
    std::vector<gpu::Image> images() const;

private:
    void add(gpu::Recorder& recorder, const std::vector<Capture>& captures, const ShadowMaps& maps,
             const std::vector<FittedLight>& batch) const;

    FrameOptions options_;
    std::vector<FrameLight> lights_;
    std::vector<ShadowMaps> maps_; // one for each size
};

} // namespace luxel
