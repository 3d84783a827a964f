// SPDX-License-Identifier: MIT
// The procedural scenes with mirrors and glass: caustics in rooms, and boxes that mirrors show.
#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

#include "scene/procedural_parts.h"
#include "shared/random.h"

namespace luxel {
namespace {

using namespace procedural;

constexpr int slices = 128, stacks = 64; // of smooth objects

// An empty tumbler: a closed solid with a thick bottom, its wall leaning outward, its lip a half circle.
void add_tumbler(Mesh& mesh, glm::vec3 base, float foot, float mouth, float height, float wall) {
    const float bottom = 3.0f * wall, lean = mouth - foot;
    const float slope = std::hypot(lean, height), radial = height / slope, down = -lean / slope;
    const auto inner = [&](float y) { return foot + lean * y / height - wall; };
    add_revolved(mesh, base, {{0, 0, 0, -1}, {foot, 0, 0, -1}}, slices);
    add_revolved(mesh, base, {{foot, 0, radial, down}, {mouth, height, radial, down}}, slices);

    std::vector<OutlinePoint> lip;
    for (int i = 0; i <= 8; ++i) {
        const float phi = shared::PI * float(i) / 8.0f, c = std::cos(phi), s = std::sin(phi);
        lip.push_back({mouth + wall / 2 * (c - 1.0f), height + wall / 2 * s, c, s});
    }
    add_revolved(mesh, base, lip, slices);
    add_revolved(mesh, base,
                 {{inner(height), height, -radial, -down}, {inner(bottom), bottom, -radial, -down}}, slices);
    add_revolved(mesh, base, {{inner(bottom), bottom, 0, 1}, {0, bottom, 0, 1}}, slices);
}

// Light from above meets about a pool's depth below the surface.
constexpr Waves pool_waves = {.level = 1.2f, .curvature = 1.6f, .lengths = {0.9f, 0.6f, 0.43f, 0.31f}};

// Checks of two tones, each of its own shade, on a gradient: no two places of a wall look alike.
Texture painted(const std::string& name, int wall, glm::vec3 tone) {
    constexpr int side = 256, check = 16;
    Texture texture;
    texture.name = name;
    texture.srgb = true;
    texture.wrap_u = texture.wrap_v = Wrap::clamp;
    texture.pixels = {side, side, std::vector<std::uint8_t>(std::size_t(side) * side * 4, 255)};
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const int column = x / check, row = y / check;
            const float shade = shared::uniform_float(
                shared::hash3(shared::uint(column), shared::uint(row), shared::uint(wall)));
            const glm::vec3 gradient(float(x) / side, float(y) / side, 1.0f - float(x) / side);
            glm::vec3 color = glm::mix(tone, gradient, 0.25f) * (0.6f + 0.4f * shade);
            if ((column + row) % 2 == 0) color = glm::mix(color, glm::vec3(0.9f), 0.35f);
            for (int c = 0; c < 3; ++c)
                texture.pixels.rgba[std::size_t(4 * (y * side + x) + c)] =
                    std::uint8_t(std::lround(255.0f * color[c]));
        }
    return texture;
}

// The closed cube [-1, 1]^3 with its own picture on each wall, lit by a lamp near an upper corner.
Scene painted_box() {
    struct Wall {
        const char* name;
        glm::vec3 corner, u, v, tone;
    };
    const Wall walls[] = {
        {"left wall", {-1, -1, 1}, {0, 0, -2}, {0, 2, 0}, {0.8f, 0.15f, 0.1f}},
        {"right wall", {1, -1, -1}, {0, 0, 2}, {0, 2, 0}, {0.15f, 0.7f, 0.2f}},
        {"back wall", {-1, -1, -1}, {2, 0, 0}, {0, 2, 0}, {0.2f, 0.3f, 0.8f}},
        {"front wall", {1, -1, 1}, {-2, 0, 0}, {0, 2, 0}, {0.8f, 0.7f, 0.15f}},
        {"floor", {-1, -1, 1}, {2, 0, 0}, {0, 0, -2}, {0.55f, 0.5f, 0.45f}},
        {"ceiling", {-1, 1, -1}, {2, 0, 0}, {0, 0, 2}, {0.6f, 0.3f, 0.7f}},
    };
    Scene scene;
    for (const Wall& wall : walls) {
        Material material = lambertian(wall.name, glm::vec3(0.8f));
        material.base_color_texture.texture = int(scene.textures.size());
        scene.textures.push_back(painted(wall.name, int(scene.textures.size()), wall.tone));
        add_quad_object(scene, material, wall.corner, wall.u, wall.v);
    }
    scene.lights = {point_light({0.6f, 0.85f, 0.7f}, 2.5f)};
    scene.cameras = {camera_at({0.0f, 0.2f, 0.97f}, {0.0f, -0.05f, 0.0f}, 75.0f)};
    return scene;
}

} // namespace

Scene glass_sphere() {
    Scene scene;
    scene.name = "glass-sphere";
    add_gray_room(scene);
    add_sphere(add_specular_object(scene, glass("sphere", 1.5f)), {0.0f, 0.62f, 0.0f}, 0.3f, slices, stacks);
    scene.lights = {spot_light({0.5f, 1.95f, 0.2f}, {0.0f, 0.62f, 0.0f}, 10.0f, 25.0f, 40.0f)};
    scene.cameras = {camera_at({0.0f, 1.4f, 3.6f}, {0.0f, 0.6f, 0.0f}, 34.0f)};
    return scene;
}

Scene metal_ring() {
    Scene scene;
    scene.name = "metal-ring";
    add_quad_object(scene, lambertian("floor", glm::vec3(0.7f)), {-2, 0, -2}, {0, 0, 4}, {4, 0, 0});
    add_ring(add_specular_object(scene, mirror("ring", {0.95f, 0.8f, 0.5f})), glm::vec3(0.0f), 0.5f, 0.53f,
             0.3f, slices);
    scene.lights = {point_light({1.2f, 0.95f, 1.5f}, 10.0f)};
    scene.cameras = {camera_at({0.0f, 2.5f, 1.1f}, {0.0f, 0.0f, -0.05f}, 34.0f)};
    return scene;
}

Scene water(float seconds) {
    Scene scene;
    scene.name = "water";
    add_gray_room(scene);
    add_height_field(add_specular_object(scene, glass("water", 1.33f)), 1.0f, 256,
                     [seconds](float x, float z) { return wave_height(pool_waves, x, z, seconds); });
    scene.lights = {spot_light({0.2f, 1.98f, 0.1f}, {0.0f, 0.0f, 0.0f}, 10.0f, 50.0f, 70.0f)};
    scene.cameras = {camera_at({0.0f, 0.75f, 3.2f}, {0.0f, 0.45f, 0.0f}, 34.0f),
                     camera_at({0.0f, 1.85f, 2.4f}, {0.0f, 0.9f, 0.0f}, 44.0f)};
    scene.cameras[0].name = "below", scene.cameras[1].name = "above";
    return scene;
}

Scene glass_metal() {
    Scene scene;
    scene.name = "glass-metal";
    add_gray_room(scene);
    add_ring(add_specular_object(scene, mirror("ring", {0.95f, 0.8f, 0.5f})), {-0.42f, 0.0f, 0.4f}, 0.27f,
             0.29f, 0.18f, slices);
    add_sphere(add_specular_object(scene, glass("glass sphere", 1.5f)), {0.45f, 0.26f, 0.45f}, 0.25f, slices,
               stacks);
    add_sphere(add_specular_object(scene, mirror("mirror ball", glm::vec3(0.9f))), {0.5f, 0.32f, -0.45f},
               0.32f, slices, stacks);
    add_tumbler(add_specular_object(scene, glass("tumbler", 1.5f)), {-0.25f, 0.001f, -0.35f}, 0.2f, 0.26f,
                0.62f, 0.025f);
    scene.lights = {point_light({-0.55f, 1.7f, -0.5f}, 3.0f)};
    scene.cameras = {camera_at({0.0f, 1.35f, 3.3f}, {0.0f, 0.4f, 0.0f}, 32.0f)};
    return scene;
}

Scene mirror_box() {
    Scene scene = painted_box();
    scene.name = "mirror-box";
    add_sphere(add_specular_object(scene, mirror("sphere", glm::vec3(0.95f))), glm::vec3(0.0f), 0.4f, slices,
               stacks);
    return scene;
}

Scene teapot_box() {
    Scene scene = painted_box();
    scene.name = "teapot-box";
    const Material metal = mirror("teapot", glm::vec3(0.95f));

    // Body with lid and knob, standing in the middle.
    add_revolved(add_specular_object(scene, metal), {0.0f, -0.4f, 0.0f},
                 smooth_outline({{0, 0},
                                 {0.24f, 0.0f},
                                 {0.38f, 0.12f},
                                 {0.42f, 0.28f},
                                 {0.35f, 0.44f},
                                 {0.22f, 0.53f},
                                 {0.1f, 0.56f},
                                 {0.05f, 0.6f},
                                 {0.075f, 0.66f},
                                 {0.05f, 0.71f},
                                 {0, 0.72f}},
                                10),
                 slices);

    // The handle is a torus in the xy plane whose inner half is inside the body, the spout a leaning cone.
    const glm::mat4 handle = glm::rotate(glm::translate(glm::mat4(1.0f), {-0.42f, -0.1f, 0.0f}),
                                         radians(90.0f), glm::vec3(1, 0, 0));
    add_torus(add_specular_object(scene, metal), glm::vec3(0.0f), 0.17f, 0.035f, slices, stacks);
    scene.instances.back().transform = handle;
    const glm::mat4 spout = glm::rotate(glm::translate(glm::mat4(1.0f), {0.33f, -0.2f, 0.0f}),
                                        radians(-50.0f), glm::vec3(0, 0, 1));
    add_revolved(
        add_specular_object(scene, metal), glm::vec3(0.0f),
        smooth_outline({{0, 0}, {0.1f, 0}, {0.08f, 0.12f}, {0.05f, 0.3f}, {0.035f, 0.4f}, {0, 0.42f}}, 10),
        slices);
    scene.instances.back().transform = spout;
    return scene;
}

} // namespace luxel
