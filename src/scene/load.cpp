// SPDX-License-Identifier: MIT
// Chooses the reader for a scene source and completes what the scene lacks.
#include "scene/load.h"

#include <algorithm>
#include <filesystem>

#include "core/error.h"
#include "core/image_io.h"
#include "scene/environment.h"
#include "scene/gltf/gltf.h"
#include "scene/lights.h"
#include "scene/obj.h"
#include "scene/procedural_builtin.h"
#include "scene/recenter.h"
#include "scene/scene_file.h"
#include "scene/validate.h"
#include "scene/views.h"
#include "shared/sampling.h"

namespace luxel {
namespace {

constexpr std::string_view builtin_prefix = "builtin:";

std::string lower_case_extension(const std::filesystem::path& path) {
    std::string extension = path.extension().string();
    for (char& c : extension)
        if (c >= 'A' && c <= 'Z') c = char(c - 'A' + 'a');
    return extension;
}

bool is_gltf(const std::string& source) {
    const std::string extension = lower_case_extension(source);
    return extension == ".gltf" || extension == ".glb";
}

bool emits(const Scene& scene) {
    const auto shines = [](const shared::Light& light) { return luminance(light.intensity) > 0.0f; };
    return std::any_of(scene.lights.begin(), scene.lights.end(), shines) || !scene.environment.empty() ||
           !emissive_triangles(scene).empty();
}

Environment default_sky() { return gradient_sky({0.9f, 0.95f, 1.0f}, {0.3f, 0.5f, 0.9f}, glm::vec3(0.2f)); }

void replace_environment(Scene& scene, const LoadOptions& options) {
    if (options.environment.empty()) return;
    if (options.environment == "sky") {
        scene.environment = default_sky();
    } else {
        scene.environment = {};
        const Image picture = read_image(options.environment, &scene.warnings);
        scene.environment.radiance = environment_map(picture, options.environment, scene.warnings);
    }
    scene.environment.scale = options.environment_scale;
}

// Something to see the scene from and something to see it by.
void add_defaults(Scene& scene, const std::string& source) {
    if (scene.cameras.empty()) {
        scene.cameras = default_cameras(scene);
        scene.warnings.push_back(
            fmt::format("{}: the scene has no camera; three views from outside are used", source));
    }
    if (!emits(scene)) {
        scene.environment = default_sky();
        scene.warnings.push_back(fmt::format(
            "{}: the scene has no light; a sky from (0.9, 0.95, 1) at the horizon to (0.3, 0.5, 0.9) at "
            "the zenith, over a ground of 0.2, is used",
            source));
    }
}

// Exporters that write lumens for watts make punctual lights 683 times as bright beside everything else.
void warn_of_bright_lights(Scene& scene, const std::string& source, const LoadOptions& options) {
    constexpr float suspicious = 30.0f;
    if (options.lights != LightUnits::photometric || !is_gltf(source)) return;
    float brightest = 0.0f; // emissive surface or texel of the sky
    for (const Material& m : scene.materials) brightest = std::max(brightest, luminance(m.emission));
    for (std::size_t i = 0; !scene.environment.empty() && i < scene.environment.radiance.pixels(); ++i) {
        const float* p = &scene.environment.radiance.data[3 * i];
        brightest = std::max(brightest, scene.environment.scale * luminance(glm::vec3(p[0], p[1], p[2])));
    }
    if (brightest <= 0.0f) return;

    // A white wall half way to the scene's edge, lit by the brightest lamp, beside the brightest surface.
    const float distance = 0.5f * scene.bounds().radius();
    float lit = 0.0f;
    for (const shared::Light& light : scene.lights)
        if (light.type == shared::LIGHT_POINT || light.type == shared::LIGHT_SPOT)
            lit = std::max(lit, luminance(light.intensity) / (shared::PI * distance * distance));
    if (lit > suspicious * brightest)
        scene.warnings.push_back(
            fmt::format("{}: a lamp makes walls {:.0f} times as bright as the brightest surface or sky that "
                        "shines by itself; if "
                        "the file's exporter wrote 683 lumens for a watt, give --lights watts",
                        source, lit / brightest));
}

} // namespace

Scene load_geometry(const std::string& source, const LoadOptions& options) {
    if (source.starts_with(builtin_prefix)) return builtin_scene(source.substr(builtin_prefix.size()));
    const std::string extension = lower_case_extension(source);
    if (is_gltf(source)) return load_gltf(source, options);
    if (extension == ".obj") {
        Scene scene = load_obj(source, options);
        recenter(scene);
        return scene;
    }
    fail(Fault::bad_input,
         "{}: unknown kind of scene; supported are .gltf, .glb, .obj, .toml and builtin:NAME", source);
}

Scene load_scene(const std::string& source, const LoadOptions& options) {
    const bool wrapped = !source.starts_with(builtin_prefix) && lower_case_extension(source) == ".toml";
    Scene scene = wrapped ? load_scene_file(source, options) : load_geometry(source, options);
    scene.brdf = options.brdf;
    replace_environment(scene, options);
    validate_scene(scene, source);
    warn_of_bright_lights(scene, source, options);
    add_defaults(scene, source);
    return scene;
}

} // namespace luxel
