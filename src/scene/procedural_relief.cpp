// SPDX-License-Identifier: MIT
// A cobbled floor and a brick wall whose detail is in height maps.
#include <algorithm>
#include <cmath>
#include <functional>

#include "scene/procedural.h"
#include "scene/procedural_parts.h"

namespace luxel {
namespace {

using namespace procedural;

constexpr int texels = 64;   // of a tile, each way
constexpr float tile = 0.8f; // meters
constexpr float pi = shared::PI;

std::uint8_t to_byte(float v) { return std::uint8_t(std::lround(std::clamp(v, 0.0f, 1.0f) * 255.0f)); }

// One tile of a texture; the function is asked at the texels' centers, in [0, 1)^2.
TextureUse add_tile(Scene& scene, const std::string& name, bool srgb, glm::vec2 extent,
                    const std::function<glm::vec3(glm::vec2)>& color) {
    Texture texture;
    texture.name = name;
    texture.srgb = srgb;
    texture.pixels.width = texture.pixels.height = texels;
    for (int y = 0; y < texels; ++y)
        for (int x = 0; x < texels; ++x) {
            const glm::vec3 c = color((glm::vec2(float(x), float(y)) + 0.5f) / float(texels));
            texture.pixels.rgba.insert(texture.pixels.rgba.end(),
                                       {to_byte(c.r), to_byte(c.g), to_byte(c.b), 255});
        }
    scene.textures.push_back(std::move(texture));
    TextureUse use{.texture = int(scene.textures.size() - 1)};
    use.transform[0][0] = extent.x / tile, use.transform[1][1] = extent.y / tile;
    return use;
}

// Sixteen round stones on a square grid.
float cobble(glm::vec2 uv) {
    const auto wave = [](float x) { return 0.5f - 0.5f * std::cos(8.0f * pi * x); };
    return wave(uv.x) * wave(uv.y);
}

// Four courses of two bricks, half a brick apart; 1 on a brick, 0 in the joints, a bevel between.
float brick(glm::vec2 uv) {
    const float course = std::floor(uv.y * 4.0f);
    const glm::vec2 size(0.4f, 0.2f);
    const glm::vec2 in = glm::fract(glm::vec2(uv.x * 2.0f + 0.5f * course, uv.y * 4.0f)) * size;
    const glm::vec2 edge = glm::min(in, size - in);
    return std::clamp((std::min(edge.x, edge.y) - 0.0125f) / 0.0375f, 0.0f, 1.0f);
}

Material relief_material(Scene& scene, const std::string& name, glm::vec2 extent, float meters,
                         const std::function<float(glm::vec2)>& height, glm::vec3 low, glm::vec3 high) {
    Material m = lambertian(name, glm::vec3(1.0f));
    m.base_color_texture = add_tile(scene, name + " color", true, extent,
                                    [&](glm::vec2 uv) { return glm::mix(low, high, height(uv)); });
    m.height_texture =
        add_tile(scene, name + " height", false, extent, [&](glm::vec2 uv) { return glm::vec3(height(uv)); });
    m.height_scale = meters;
    return m;
}

} // namespace

Scene relief() {
    Scene scene;
    scene.name = "relief";

    // Both go on behind where they meet, so that no gap opens between what lies behind them.
    add_quad_object(
        scene,
        relief_material(scene, "floor", {4, 4}, 0.05f, cobble, {0.35f, 0.3f, 0.25f}, {0.75f, 0.75f, 0.7f}),
        {-2, 0, 2.4f}, {4, 0, 0}, {0, 0, -4});
    add_quad_object(
        scene,
        relief_material(scene, "wall", {4, 2.4f}, 0.03f, brick, {0.7f, 0.7f, 0.65f}, {0.75f, 0.35f, 0.25f}),
        {-2, -0.4f, -1.2f}, {4, 0, 0}, {0, 2.4f, 0});
    add_sphere(add_object(scene, lambertian("ball", {0.3f, 0.45f, 0.7f})), {-0.2f, 0.2f, -0.3f}, 0.2f, 64,
               32);

    shared::Light sun{};
    sun.type = shared::LIGHT_DIRECTIONAL;
    sun.direction = glm::normalize(glm::vec3(0.8f, -0.5f, -0.45f));
    sun.intensity = glm::vec3(4.0f);
    scene.lights = {sun};
    scene.cameras = {camera_at({0.5f, 0.55f, 1.4f}, {-0.15f, 0.2f, -1.2f}, 42.0f)};
    return scene;
}

} // namespace luxel
