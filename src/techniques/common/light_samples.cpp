// SPDX-License-Identifier: MIT
#include "techniques/common/light_samples.h"

#include "scene/lights.h"

namespace luxel {

void LightSamples::visit(Visitor& v) {
    v.integer("environment_lights", environment, {0, 256},
              "directional samples of the environment that send light");
    v.integer("emitter_lights", emitters, {0, 256}, "samples of emissive surfaces that send light");
}

Need light_need(const Scene& scene, const LightSamples& samples) {
    bool any = !scene.lights.empty() || (samples.environment > 0 && !scene.environment.empty());
    for (const Instance& instance : scene.instances) {
        const Mesh& mesh = scene.meshes[std::size_t(instance.mesh)];
        const glm::vec3 emission = scene.materials[std::size_t(mesh.material)].emission;
        any |= samples.emitters > 0 && emission != glm::vec3(0.0f);
    }
    return {"a light", any};
}

Need light_need(const Scene& scene, const FrameOptions& frame) {
    const bool lights = frame.environment == EnvironmentMode::lights;
    return light_need(scene, LightSamples{.emitters = frame.emitter_lights,
                                          .environment = lights ? frame.environment_lights : 0});
}

std::vector<shared::Light> lights_with_samples(const Scene& scene, const LightSamples& samples) {
    std::vector<shared::Light> lights = scene.lights;
    auto add = [&](const std::vector<shared::Light>& more) {
        lights.insert(lights.end(), more.begin(), more.end());
    };
    if (samples.emitters > 0) add(emitter_sample_lights(scene, samples.emitters, 1));
    if (samples.environment > 0 && !scene.environment.empty())
        add(environment_sample_lights(scene.environment, samples.environment, 1));
    return lights;
}

} // namespace luxel
