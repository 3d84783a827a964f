// SPDX-License-Identifier: MIT
#include "techniques/frame/direct_light.h"

#include <algorithm>
#include <utility>

#include "core/error.h"
#include "scene/lights.h"
#include "techniques/frame/direct_params.h"

namespace luxel {
namespace {

// Memory of one batch's depth maps. Batches are drawn and kept as a whole, so small ones are kept longer;
// each costs a pass over the pixels.
constexpr std::uint64_t batch_bytes = std::uint64_t(128) << 20;
constexpr int least_map_size = 64;

// As many maps as a batch may have; a cube must fit.
int batch_maps(int size, bool with_sheets) {
    const int affordable = int(batch_bytes / ShadowMaps::bytes_of(size, 1, ShadowMode::hard, with_sheets));
    return std::min(shared::MAX_BATCH_MAPS, std::max(affordable, 6));
}

// Whether the light's maps depend on what the camera sees.
bool follows_camera(const shared::Light& light) { return light.type == shared::LIGHT_DIRECTIONAL; }

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
    std::stable_sort(lights.begin(), lights.end(), [](const FrameLight& a, const FrameLight& b) {
        return std::pair(a.map_size, follows_camera(a.light)) >
               std::pair(b.map_size, follows_camera(b.light));
    });
    return lights;
}

DirectLight::DirectLight(const Scene& scene, const FrameOptions& options)
    : options_(options), lights_(frame_lights(scene, options)) {}

void DirectLight::render(gpu::Recorder& recorder, ShadowCache& shadows,
                         const std::vector<Capture>& captures) const {
    LUXEL_ASSERT(!captures.empty(), "lights={}", lights_.size());
    const Bounds& scene = captures.front().scene->bounds();
    const bool sheets = !captures.front().scene->sheets().empty();
    std::vector<glm::vec3> receivers;
    for (const Capture& c : captures)
        for (glm::vec3 corner : common_corners(scene, frustum_of(c.view.world_to_clip), c.view.position))
            receivers.push_back(corner);

    // A batch ends where the maps' size or their dependence on the camera changes, or where it is full.
    for (std::size_t next = 0; next < lights_.size();) {
        const FrameLight& first = lights_[next];
        std::vector<FittedLight> batch;
        int used = 0;
        for (; next < lights_.size(); ++next) {
            const FrameLight& l = lights_[next];
            const int count = shadow_map_count(l.light);
            if (l.map_size != first.map_size || follows_camera(l.light) != follows_camera(first.light) ||
                used + count > batch_maps(l.map_size, sheets) || int(batch.size()) == shared::MAX_BATCH_LIGHTS)
                break;
            batch.push_back(fit_shadow_maps(l.light, scene, receivers, l.map_size));
            batch.back().light.first_map = shared::uint(used);
            used += count;
        }
        add(recorder, shadows, captures, first.map_size, batch);
    }
}

void DirectLight::add(gpu::Recorder& recorder, ShadowCache& shadows, const std::vector<Capture>& captures,
                      int map_size, const std::vector<FittedLight>& batch) const {
    LUXEL_ASSERT(!batch.empty(), "map_size={}", map_size);
    std::vector<shared::ShadowView> views;
    for (const FittedLight& l : batch) views.insert(views.end(), l.views.begin(), l.views.end());
    const Capture& first = captures.front();
    const ShadowImages maps = shadows.maps(recorder, *first.scene, map_size, views, first.search);
    const bool sheets = bool(maps.sheets.nearest);

    shared::DirectParams p{
        .esm_exponent = options_.esm_exponent, .light_count = int(batch.size()), .map_size = float(map_size)};
    for (std::size_t i = 0; i < batch.size(); ++i) p.lights[i] = batch[i].light;
    std::copy(views.begin(), views.end(), p.maps);
    static constexpr const char* programs[][2] = {{"frame/direct_hard.comp", "frame/direct_hard_sheets.comp"},
                                                  {"frame/direct_pcf.comp", "frame/direct_pcf_sheets.comp"},
                                                  {"frame/direct_esm.comp", "frame/direct_esm_sheets.comp"}};
    for (const Capture& c : captures) {
        p.view = c.view;
        gpu::Bindings bindings = {{"depth", c.gbuffer.depth},
                                  {"diffuse", c.gbuffer.diffuse},
                                  {"specular", c.gbuffer.specular},
                                  {"normal", c.gbuffer.normal},
                                  {"geometric_normal", c.gbuffer.geometric_normal},
                                  {"shadow_maps", maps.depth},
                                  {"direct", c.direct},
                                  {"direct_diffuse", c.direct_diffuse}};
        if (sheets) {
            bindings.push_back({"optical_depths", maps.sheets.optical_depth, gpu::Sampler::linear_clamp});
            bindings.push_back({"nearest_sheets", maps.sheets.nearest});
        }
        recorder.dispatch(programs[std::size_t(options_.shadow)][sheets], extent_of(c.direct), p, bindings);
    }
}

} // namespace luxel
