// SPDX-License-Identifier: MIT
#include "techniques/frame/frame.h"

namespace luxel {

void FrameOptions::visit(Visitor& v) {
    v.choice("shadow", shadow, {"hard", "pcf", "esm"},
             "filter of shadow maps: none, percentage-closer, exponential");
    v.integer("shadow_size", shadow_size, {64, 8192},
              "texels a side of a directional or spot light's map; cube faces have half, sampled lights half "
              "of that");
    v.integer("shadow_memory", shadow_memory, {0, 65536},
              "MiB of shadow maps kept while nothing moves, at most a quarter of the device's memory; 0: "
              "drawn for each frame");
    v.only_if(shadow == ShadowMode::esm, "shadow=esm", [&] {
        v.real("esm_exponent", esm_exponent, {1, 1000},
               "exponent of exponential shadow maps, light depth in [0, 1]");
    });
    v.integer("emitter_lights", emitter_lights, {0, 65536}, "sample lights that stand for emissive meshes");
    v.choice(
        "environment", environment, {"none", "ambient", "lights"},
        "light of the environment: none, irradiance times the occlusion slot, or sampled directional lights");
    v.only_if(environment == EnvironmentMode::lights, "environment=lights", [&] {
        v.integer("environment_lights", environment_lights, {0, 65536}, "directional lights");
    });
    v.integer("seed", seed, {0, 2147483647}, "of the sample lights");
    v.integer("supersample", supersample, {1, 8},
              "antialiasing: the frame and its techniques at this many times the width and height, then the "
              "mean of each pixel's square");
    v.integer("blend_layers", blend_layers, {0, 64},
              "nearest alpha-blended surfaces of a pixel that are drawn; farther ones are left out");
    v.flag("mipmaps", mipmaps, "off: textures are looked up bilinearly at full size, as in the reference");
}

bool has_ambient_light(const Scene& scene, const FrameOptions& options) {
    return options.environment == EnvironmentMode::ambient && !scene.environment.empty();
}

} // namespace luxel
