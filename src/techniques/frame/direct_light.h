// SPDX-License-Identifier: MIT
// Direct light of any number of lights, in batches that each have an array of shadow maps.
#pragma once
#include <vector>

#include "gpu/recorder.h"
#include "techniques/frame/frame.h"
#include "techniques/frame/shadow_cache.h"
#include "techniques/frame/shadow_maps.h"

namespace luxel {

struct FrameLight {
    shared::Light light;
    int map_size; // texels a side of each of its maps
};

// The scene's lights, samples of its emitters and, for EnvironmentMode::lights, of its environment, grouped
// by map size, and in each size those apart whose maps follow the camera.
std::vector<FrameLight> frame_lights(const Scene& scene, const FrameOptions& options);

// Adds the lights to direct and direct_diffuse of captures.
class DirectLight {
public:
    DirectLight(const Scene& scene, const FrameOptions& options);
    // Each shadow map is drawn at most once for all captures, which are of one scene; not at all where
    // `shadows` has kept it.
    void render(gpu::Recorder& recorder, ShadowCache& shadows, const std::vector<Capture>& captures) const;
    std::size_t light_count() const { return lights_.size(); }

private:
    void add(gpu::Recorder& recorder, ShadowCache& shadows, const std::vector<Capture>& captures,
             int map_size, const std::vector<FittedLight>& batch) const;

    FrameOptions options_;
    std::vector<FrameLight> lights_;
};

} // namespace luxel
