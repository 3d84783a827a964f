// SPDX-License-Identifier: MIT
// Light sources. POV-Ray's diffuse surface has no 1/pi and its lights do not fall off by themselves.
#include <algorithm>
#include <cmath>

#include "scene/environment.h"
#include "scene/export/povray/text.h"
#include "scene/lights.h"
#include "shared/sampling.h"

namespace luxel::povray {
namespace {

constexpr std::uint32_t light_seed = 1;
constexpr int dome_columns = 128, dome_rows = 64;

// A light attenuates by 2 / (1 + (r/d)^2), which is 2 d^2 / r^2 for d far below r: so the color that gives
// I / r^2 on a surface whose radiance is color x albedo is I / (2 pi d^2). Nothing is nearer than about 30 d.
void add_punctual(Export& out, const shared::Light& light, float fade_distance, const std::string& shape) {
    const glm::vec3 color = light.intensity / (2.0f * shared::PI * fade_distance * fade_distance);
    out.add("light_source {{ {} {} fade_power 2 fade_distance {:.7g}{} }}\n", vector(light.position),
            rgb(color), fade_distance, shape);
    if (light.range > 0.0f) out.note("the range of point and spot lights: their light goes on");
}

std::string spot(const shared::Light& light, const std::string& cone) {
    return fmt::format(" spotlight point_at {} {}", vector(light.position + light.direction), cone);
}

void add_light(Export& out, const shared::Light& light, const Bounds& bounds, float fade_distance) {
    const auto degrees = [](float versine) { return shared::versine_angle(versine) * (180.0f / shared::PI); };
    switch (light.type) {
    case shared::LIGHT_POINT:
        return add_punctual(out, light, fade_distance, "");
    case shared::LIGHT_SPOT:
        out.note("the soft rim of spot lights: a cubic of the cosine instead of a square");
        return add_punctual(
            out, light, fade_distance,
            spot(light, fmt::format("radius {:.7g} falloff {:.7g} tightness 0", degrees(light.inner),
                                    std::max(degrees(light.outer), degrees(light.inner) + 0.01f))));
    case shared::LIGHT_COSINE:
        // No rim within the hemisphere, and the first power of the cosine to the normal.
        return add_punctual(out, light, fade_distance, spot(light, "radius 90 falloff 90 tightness 1"));
    default:
        out.add("light_source {{ {} {} parallel point_at {} }}\n",
                vector(bounds.center() - light.direction * (4.0f * bounds.radius())),
                rgb(light.intensity / shared::PI), vector(bounds.center()));
    }
}

} // namespace

void add_lights(Export& out) {
    const Bounds bounds = out.scene.bounds();
    std::vector<shared::Light> lights = out.scene.lights;
    const auto emitters = emitter_sample_lights(out.scene, out.settings.area_lights, light_seed);
    const auto sky =
        environment_sample_lights(out.scene.environment, out.settings.environment_lights, light_seed);
    if (!emitters.empty()) out.note(fmt::format("emissive meshes: light from {} points", emitters.size()));
    if (!sky.empty()) out.note(fmt::format("the environment: light from {} directions", sky.size()));
    lights.insert(lights.end(), emitters.begin(), emitters.end());
    lights.insert(lights.end(), sky.begin(), sky.end());
    for (const shared::Light& light : lights) add_light(out, light, bounds, 1e-3f * bounds.radius());
    out.add("\n");
}

// A dome whose texture coordinates are the map's: no doubt about how a renderer winds a sphere.
void add_sky(Export& out) {
    const Environment& environment = out.scene.environment;
    const Bounds bounds = out.scene.bounds();
    const std::string name = out.stem + "-sky.exr";
    write_exr(out.folder / name, {{"", environment.radiance}});

    std::string positions, uvs, faces;
    for (int y = 0; y <= dome_rows; ++y)
        for (int x = 0; x <= dome_columns; ++x) {
            const glm::vec2 uv(float(x) / dome_columns, float(y) / dome_rows);
            // At the seam and the poles the map's own coordinates would wrap around.
            const glm::vec2 inside = glm::clamp(uv, glm::vec2(1e-6f), glm::vec2(1.0f - 1e-6f));
            const glm::vec3 direction = environment_direction(environment, inside);
            positions += "," + vector(bounds.center() + direction * (100.0f * bounds.radius()));
            uvs += fmt::format(",<{:.7g},{:.7g}>", uv.x, 1.0f - uv.y);
            if (x == dome_columns || y == dome_rows) continue;
            const int a = y * (dome_columns + 1) + x, b = a + dome_columns + 1;
            faces += fmt::format(",<{},{},{}>,<{},{},{}>", a, b, a + 1, a + 1, b, b + 1);
        }
    const int vertices = (dome_columns + 1) * (dome_rows + 1);
    out.add("mesh2 {{\nvertex_vectors {{ {}{} }}\nuv_vectors {{ {}{} }}\nface_indices {{ {}{} }}\n", vertices,
            positions, vertices, uvs, 2 * dome_columns * dome_rows, faces);
    out.add("texture {{ uv_mapping pigment {{ image_map {{ exr \"{}\" }} }} finish {{ ambient 0 diffuse 0 "
            "emission {:.7g} }} }}\nno_shadow no_radiosity hollow }}\n\n",
            name, environment.scale);
}

} // namespace luxel::povray
