// SPDX-License-Identifier: MIT
#include "techniques/common/light_samples.h"

#include "scene/lights.h"

namespace luxel {

void LightSamples::visit(Visitor& v) {
    v.integer("environment_lights", environment, {0, 256},
              "directional samples of the environment that send light");
    v.integer("emitter_lights", emitters, {0, 256}, "samples of emissive surfaces that send light");
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
