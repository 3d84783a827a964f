// SPDX-License-Identifier: MIT
#include "techniques/common/rsm.h"

#include <algorithm>

#include "shared/sampling.h"
#include "techniques/common/distance_cube.h"
#include "techniques/common/rsm_params.h"
#include "techniques/frame/projection.h"
#include "techniques/frame/shadow_maps.h"

namespace luxel {

void RsmOptions::visit(Visitor& v) {
    v.integer("rsm_size", size, {16, 4096},
              "pixels a side of a directional or spot light's reflective shadow map; cube faces have half, "
              "sampled lights half of that");
    lights.visit(v);
}

namespace {

// The near plane is where the light's shadow maps have it.
constexpr float near_by_far = 1.0f / 2048.0f;
constexpr int least_size = 16;

// Right-handed, so that fronts are fronts.
Axes camera_axes(glm::vec3 position, glm::vec3 forward, glm::vec3 right) {
    return {position, forward, right, glm::cross(right, forward)};
}

// A box around the scene, as the light sees it.
shared::ViewParams directional_view(const shared::Light& light, const Bounds& scene, int size) {
    const glm::mat3 around = shared::frame_around(glm::normalize(light.direction));
    Axes axes = camera_axes({}, around[2], around[0]);
    const glm::mat3 rows(axes.right, axes.up, axes.forward);
    Bounds box;
    for (int i = 0; i < 8; ++i)
        box.add(glm::vec3((i & 1) ? scene.most.x : scene.least.x, (i & 2) ? scene.most.y : scene.least.y,
                          (i & 4) ? scene.most.z : scene.least.z) *
                rows);

    // A thousandth more, so that the scene's rim lies inside.
    const glm::vec3 half = glm::max((box.most - box.least) * 0.5005f, glm::vec3(1e-4f));
    axes.position = rows * glm::vec3(glm::vec2(box.center()), box.center().z - half.z);
    axes.right *= half.x, axes.up *= half.y;
    return parallel_view_params(axes, 2.0f * half.z, glm::vec2(float(size)));
}

int view_size(const shared::Light& light, const RsmOptions& options, bool sampled) {
    const int divisor = (shadow_map_count(light) > 1 ? 2 : 1) * (sampled ? 2 : 1);
    return std::max(options.size / divisor, least_size);
}

RsmView make_view(gpu::Recorder& recorder, const Frame& frame, const shared::Light& light,
                  const shared::ViewParams& view, const std::string& prefix) {
    RsmView v{.seen = frame.capture_surfaces(recorder, {.view = view, .prefix = prefix}), .light = light};
    auto image = [&](const char* name) {
        return recorder.image({.width = v.seen.width, .height = v.seen.height}, prefix + name);
    };
    v.flux = image("flux"), v.reflected = image("reflected");
    recorder.dispatch("common/rsm.comp", extent_of(v.flux), shared::RsmParams{view, light},
                      {{"depth", v.seen.gbuffer.depth},
                       {"diffuse", v.seen.gbuffer.diffuse},
                       {"direct", v.seen.direct},
                       {"flux", v.flux},
                       {"reflected", v.reflected}});
    return v;
}

} // namespace

std::vector<shared::ViewParams> rsm_views(const shared::Light& light, const Bounds& scene, int size) {
    if (light.type == shared::LIGHT_DIRECTIONAL) return {directional_view(light, scene, size)};
    float far = farthest_corner(scene, light.position) * 1.001f;
    if (light.range > 0.0f) far = std::min(far, light.range);
    std::vector<shared::ViewParams> views;
    for (const LightCone& cone : light_cones(light)) {
        Axes axes = camera_axes(light.position, cone.forward, cone.right);
        axes.right *= cone.tangent, axes.up *= cone.tangent;
        views.push_back(view_params(axes, far * near_by_far, far, glm::vec2(float(size))));
    }
    return views;
}

std::vector<RsmView> reflective_shadow_maps(gpu::Recorder& recorder, const Frame& frame,
                                            const RsmOptions& options) {
    auto scope = recorder.scope("rsm");
    const Scene& scene = frame.scene->scene();
    const std::vector<shared::Light> lights = lights_with_samples(scene, options.lights);
    std::vector<RsmView> views;
    for (std::size_t i = 0; i < lights.size(); ++i) {
        const int size = view_size(lights[i], options, i >= scene.lights.size());
        for (const shared::ViewParams& view : rsm_views(lights[i], frame.scene->bounds(), size))
            views.push_back(
                make_view(recorder, frame, lights[i], view, "rsm " + std::to_string(views.size()) + " "));
    }
    return views;
}

} // namespace luxel
