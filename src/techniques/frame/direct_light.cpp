// SPDX-License-Identifier: MIT
#include "techniques/frame/direct_light.h"

#include <algorithm>
#include <map>

#include "core/error.h"
#include "scene/lights.h"
#include "techniques/frame/direct_params.h"

namespace luxel {
namespace {

// Memory that one size's depth maps may take.
constexpr std::uint64_t shadow_budget = std::uint64_t(128) << 20;
constexpr int least_map_size = 64;

// As many layers as the lights can use at once, within the budget; a cube must fit.
int layer_count(int size, int maps_of_all_lights) {
    int affordable = int(shadow_budget / (std::uint64_t(size) * std::uint64_t(size) * 4));
    int useful = std::min(maps_of_all_lights, shared::MAX_BATCH_MAPS);
    return std::min(useful, std::max(affordable, 6));
}

} // namespace

std::vector<FrameLight> frame_lights(const Scene& scene, const FrameOptions& options) {
    // A cube's faces have half the side: six of them take 1.5 times the memory of one full map. Of sampled
    // lights there are many, each with a small share of the light: an error of a texel at a shadow's border
    // counts that much less.
    std::vector<FrameLight> lights;
    auto add = [&](const shared::Light& light, int divisor) {
        if (shadow_map_count(light) > 1) divisor *= 2;
        lights.push_back({light, std::max(options.shadow_size / divisor, least_map_size)});
    };
    for (const shared::Light& light : scene.lights) add(light, 1);
    if (options.emitter_lights > 0)
        for (const shared::Light& light :
             emitter_sample_lights(scene, options.emitter_lights, std::uint32_t(options.seed)))
            add(light, 2);
    if (options.environment == EnvironmentMode::lights && !scene.environment.empty() &&
        options.environment_lights > 0)
        for (const shared::Light& light : environment_sample_lights(
                 scene.environment, options.environment_lights, std::uint32_t(options.seed)))
            add(light, 2);
    std::stable_sort(lights.begin(), lights.end(),
                     [](const FrameLight& a, const FrameLight& b) { return a.map_size > b.map_size; });
    return lights;
}

DirectLight::DirectLight(gpu::Gpu& gpu, const Scene& scene, const FrameOptions& options)
    : options_(options), lights_(frame_lights(scene, options)) {
    std::map<int, int, std::greater<>> maps_by_size;
    for (const FrameLight& l : lights_) maps_by_size[l.map_size] += shadow_map_count(l.light);
    for (auto [size, count] : maps_by_size)
        maps_.emplace_back(gpu, size, layer_count(size, count), options.shadow);
}

std::vector<gpu::Image> DirectLight::images() const {
    std::vector<gpu::Image> images;
    for (const ShadowMaps& maps : maps_)
        for (const gpu::Image& image : maps.images()) images.push_back(image);
    return images;
}

void DirectLight::render(gpu::Recorder& recorder, const std::vector<Capture>& captures) const {
    LUXEL_ASSERT(!captures.empty(), "lights={}", lights_.size());
    const Bounds& scene = captures.front().scene->bounds();
    std::vector<glm::vec3> receivers;
    for (const Capture& c : captures)
        for (glm::vec3 corner : common_corners(scene, frustum_of(c.view.world_to_clip), c.view.position))
            receivers.push_back(corner);

    // Lights are sorted by map size; a batch ends where the size changes, or the maps or the parameters are
    // full.
    std::size_t next = 0;
    for (const ShadowMaps& maps : maps_) {
        while (next < lights_.size() && lights_[next].map_size == maps.size()) {
            std::vector<FittedLight> batch;
            int used = 0;
            for (; next < lights_.size() && lights_[next].map_size == maps.size(); ++next) {
                const shared::Light& light = lights_[next].light;
                int count = shadow_map_count(light);
                if (used + count > maps.layers() || int(batch.size()) == shared::MAX_BATCH_LIGHTS) break;
                batch.push_back(fit_shadow_maps(light, scene, receivers, maps.size()));
                batch.back().light.first_map = shared::uint(used);
                used += count;
            }
            add(recorder, captures, maps, batch);
        }
    }
}

void DirectLight::add(gpu::Recorder& recorder, const std::vector<Capture>& captures, const ShadowMaps& maps,
                      const std::vector<FittedLight>& batch) const {
    LUXEL_ASSERT(!batch.empty(), "layers={}", maps.layers());
    std::vector<shared::ShadowView> views;
    for (const FittedLight& l : batch) views.insert(views.end(), l.views.begin(), l.views.end());
    const Capture& first = captures.front();
    gpu::Image shadow_maps = maps.draw(recorder, *first.scene, views, options_.esm_exponent, first.search);

    shared::DirectParams p{.esm_exponent = options_.esm_exponent,
                           .light_count = int(batch.size()),
                           .map_size = float(maps.size())};
    for (std::size_t i = 0; i < batch.size(); ++i) p.lights[i] = batch[i].light;
    std::copy(views.begin(), views.end(), p.maps);
    static constexpr const char* programs[] = {"frame/direct_hard.comp", "frame/direct_pcf.comp",
                                               "frame/direct_esm.comp"};
    for (const Capture& c : captures) {
        p.view = c.view;
        recorder.dispatch(programs[std::size_t(options_.shadow)], extent_of(c.direct), p,
                          {{"depth", c.gbuffer.depth},
                           {"diffuse", c.gbuffer.diffuse},
                           {"specular", c.gbuffer.specular},
                           {"normal", c.gbuffer.normal},
                           {"geometric_normal", c.gbuffer.geometric_normal},
                           {"shadow_maps", shadow_maps},
                           {"direct", c.direct},
                           {"direct_diffuse", c.direct_diffuse}});
    }
}

} // namespace luxel
