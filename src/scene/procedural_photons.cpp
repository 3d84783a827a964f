// SPDX-License-Identifier: MIT
// Scenes after those of [Le2014, chapter 4], with their triangle counts: rings and water under one spot
// light.
#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

#include "scene/procedural.h"
#include "scene/procedural_parts.h"

namespace luxel {
namespace {

using namespace procedural;

constexpr glm::vec3 gold(0.95f, 0.8f, 0.5f);

// A solid whose surface every ray from its middle meets once: a body, a head and two ears.
float bunny_radius(glm::vec3 direction) {
    struct Bump {
        glm::vec3 toward;
        float size, sharpness;
    };
    const Bump bumps[] = {{{0.75f, 0.66f, 0.0f}, 0.75f, 6.0f},
                          {{0.35f, 0.93f, 0.3f}, 1.5f, 40.0f},
                          {{0.35f, 0.93f, -0.3f}, 1.5f, 40.0f},
                          {{-0.95f, -0.2f, 0.0f}, 0.25f, 20.0f}};
    float radius = 1.0f;
    for (const Bump& bump : bumps)
        radius +=
            bump.size * std::exp(bump.sharpness * (glm::dot(direction, glm::normalize(bump.toward)) - 1.0f));
    return radius;
}

// It stands on y = base.y; `size` is the radius of its body. With 194 slices and 180 stacks it has 69452
// triangles, one more than the Stanford bunny, which is not closed.
void add_bunny(Mesh& mesh, glm::vec3 base, float size, float turn) {
    constexpr int slices = 194, stacks = 180;
    add_sphere(mesh, glm::vec3(0.0f), 1.0f, slices, stacks);
    const glm::mat3 frame(glm::rotate(glm::mat4(1.0f), turn, glm::vec3(0, 1, 0)));
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        // The normal of |p| = r(p / |p|) is that function's gradient, by differences.
        const glm::vec3 d = mesh.positions[i];
        const float r = bunny_radius(d), step = 1e-2f;
        glm::vec3 slope;
        for (int k = 0; k < 3; ++k) {
            glm::vec3 e(0.0f);
            e[k] = step;
            slope[k] =
                (bunny_radius(glm::normalize(d + e)) - bunny_radius(glm::normalize(d - e))) / (2 * step);
        }
        mesh.positions[i] = base + frame * (glm::vec3(0.0f, size, 0.0f) + d * (size * r));
        mesh.normals[i] = frame * glm::normalize(d * r - slope);
    }
}

void add_panel(Scene& scene, const char* name, glm::vec3 color, glm::vec3 corner, glm::vec3 u, glm::vec3 v) {
    add_quad_object(scene, lambertian(name, color), corner, u, v);
}

constexpr Waves ripples = {.level = 0.35f, .curvature = 0.7f, .lengths = {1.1f, 0.75f, 0.53f, 0.4f}};

} // namespace

Scene ring() {
    Scene scene;
    scene.name = "ring";
    add_gray_room(scene);
    add_ring(add_specular_object(scene, mirror("ring", gold)), {0.3f, 0.0f, 0.1f}, 0.46f, 0.52f, 0.21f, 24);
    scene.lights = {spot_light({-0.8f, 1.3f, 0.7f}, {0.3f, 0.1f, 0.1f}, 12.0f, 30.0f, 45.0f)};
    scene.cameras = {camera_at({0.0f, 1.95f, 2.9f}, {0.1f, 0.4f, 0.0f}, 38.0f)};
    return scene;
}

// Four walls stand one behind the other between the camera and the ring: whoever captures four layers sees
// nothing of the platform that the ring's light falls on. No light reaches the lower platform behind the
// walls.
Scene occluded_ring() {
    Scene scene;
    scene.name = "occluded-ring";
    add_gray_room(scene);
    add_ring(add_specular_object(scene, mirror("ring", gold)), {0.0f, 0.55f, -0.45f}, 0.25f, 0.28f, 0.2f, 24);
    add_panel(scene, "upper platform", glm::vec3(0.7f), {-1, 0.55f, -1}, {0, 0, 1.12f}, {2, 0, 0});
    add_panel(scene, "lower platform", glm::vec3(0.7f), {-1, 0.15f, -1}, {0, 0, 1.4f}, {2, 0, 0});
    for (int i = 0; i < 4; ++i)
        add_panel(scene, "front wall", {0.3f, 0.4f, 0.65f}, {-1, 0.45f, 0.15f + 0.05f * float(i)}, {2, 0, 0},
                  {0, 0.5f, 0});
    scene.lights = {spot_light({-0.3f, 1.95f, 0.8f}, {0.0f, 0.6f, -0.4f}, 15.0f, 30.0f, 45.0f)};
    scene.cameras = {camera_at({0.0f, 0.75f, 3.3f}, {0.0f, 0.65f, 0.0f}, 34.0f)};
    return scene;
}

Scene bunnies_ring() {
    Scene scene;
    scene.name = "bunnies-ring";
    add_gray_room(scene);
    add_ring(add_specular_object(scene, mirror("ring", gold)), {0.0f, 0.0f, 0.3f}, 0.34f, 0.38f, 0.16f, 32);
    const Material fur = lambertian("bunny", glm::vec3(0.7f));
    add_bunny(add_object(scene, fur), {-0.6f, 0.0f, -0.25f}, 0.19f, 0.4f);
    add_bunny(add_object(scene, fur), {0.02f, 0.0f, -0.55f}, 0.19f, -0.9f);
    add_bunny(add_object(scene, fur), {0.62f, 0.0f, -0.25f}, 0.19f, 2.6f);
    scene.lights = {spot_light({0.8f, 1.4f, 0.95f}, {0.0f, 0.1f, 0.1f}, 12.0f, 30.0f, 45.0f)};
    scene.cameras = {camera_at({0.0f, 1.9f, 2.9f}, {0.0f, 0.35f, 0.0f}, 36.0f)};
    return scene;
}

Scene water_room(float seconds) {
    Scene scene;
    scene.name = "water-room";
    add_gray_room(scene);
    add_height_field(add_specular_object(scene, glass("water", 1.33f)), 1.0f, 31,
                     [seconds](float x, float z) { return wave_height(ripples, x, z, seconds); });
    scene.lights = {spot_light({0.55f, 1.9f, 0.75f}, {-0.1f, 0.35f, -0.2f}, 20.0f, 30.0f, 45.0f)};
    scene.cameras = {camera_at({0.0f, 1.35f, 3.4f}, {0.0f, 0.9f, 0.0f}, 38.0f)};
    return scene;
}

Scene pool(float seconds) {
    Scene scene;
    scene.name = "pool";

    // The rim is four boxes, the water a sheet from rim to rim, a little above a floor of its own.
    constexpr float half = 1.0f, stone = 0.15f, rim = 0.45f;
    Mesh& basin = add_object(scene, lambertian("basin", {0.6f, 0.55f, 0.48f}));
    const float out = half + stone;
    add_box(basin, {-out, 0, -out}, {out, rim, -half});
    add_box(basin, {-out, 0, half}, {out, rim, out});
    add_box(basin, {-out, 0, -half}, {-half, rim, half});
    add_box(basin, {half, 0, -half}, {out, rim, half});
    add_panel(scene, "basin floor", {0.6f, 0.62f, 0.6f}, {-half, 0.02f, -half}, {0, 0, 2 * half},
              {2 * half, 0, 0});
    add_height_field(add_specular_object(scene, glass("water", 1.33f)), half, 64,
                     [seconds](float x, float z) { return wave_height(ripples, x, z, seconds); });
    scene.lights = {spot_light({1.5f, 3.0f, 1.0f}, {0.0f, 0.3f, 0.0f}, 40.0f, 20.0f, 40.0f)};
    scene.cameras = {camera_at({0.5f, 2.2f, 3.6f}, {0.0f, 0.25f, 0.0f}, 42.0f)};
    return scene;
}

} // namespace luxel
