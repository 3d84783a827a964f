// SPDX-License-Identifier: MIT
#include "scene/procedural_interiors.h"

#include <cmath>

#include "scene/lights.h"
#include "scene/procedural.h"
#include "scene/procedural_parts.h"

namespace luxel {
namespace {

using namespace procedural;
using glm::vec3;

constexpr vec3 plaster{0.75f, 0.73f, 0.7f}, wood{0.45f, 0.28f, 0.15f};

// A box whose walls have a thickness, so that neither light nor shadow maps pass through them. Openings are
// left by leaving pieces out.
void add_slab(Scene& scene, const char* name, vec3 albedo, vec3 least, vec3 most) {
    add_box(add_object(scene, lambertian(name, albedo)), least, most);
}

// A wall across x at `x`, along z, with windows of 1 m x 1.4 m every 2 m.
void add_window_wall(Scene& scene, float x, float thickness, float length, float height) {
    Mesh& wall = add_object(scene, lambertian("window wall", plaster));
    constexpr float sill = 0.9f, head = 2.3f;
    add_box(wall, {x, 0, 0}, {x + thickness, sill, length});
    add_box(wall, {x, head, 0}, {x + thickness, height, length});
    for (float z = 0.0f; z < length; z += 2.0f)
        add_box(wall, {x, sill, z}, {x + thickness, head, std::min(z + 1.0f, length)});
}

// Floor, ceiling and three walls around [0, width] x [0, height] x [0, length]; the wall at x = 0 is left
// out.
void add_shell(Scene& scene, float width, float height, float length, float thickness) {
    const float t = thickness;
    add_slab(scene, "floor", wood, {-t, -t, -t}, {width + t, 0, length + t});
    add_slab(scene, "ceiling", plaster, {-t, height, -t}, {width + t, height + t, length + t});
    add_slab(scene, "front wall", plaster, {0, 0, -t}, {width, height, 0});
    add_slab(scene, "back wall", plaster, {0, 0, length}, {width, height, length + t});
    add_slab(scene, "inner wall", {0.6f, 0.35f, 0.25f}, {width, 0, -t}, {width + t, height, length + t});
}

void add_daylight(Scene& scene, vec3 sun_direction) {
    scene.environment = gradient_sky({0.9f, 0.95f, 1.0f}, {0.3f, 0.5f, 0.9f}, vec3(0.2f));
    shared::Light sun{};
    sun.type = shared::LIGHT_DIRECTIONAL;
    sun.direction = glm::normalize(sun_direction), sun.intensity = {12.0f, 11.0f, 9.5f};
    scene.lights = {sun};
}

// A top on four legs.
void add_table(Mesh& mesh, vec3 corner, float width, float depth, float height) {
    constexpr float top = 0.03f, leg = 0.04f;
    add_box(mesh, corner + vec3(0, height - top, 0), corner + vec3(width, height, depth));
    for (float x : {0.0f, width - leg})
        for (float z : {0.0f, depth - leg})
            add_box(mesh, corner + vec3(x, 0, z), corner + vec3(x + leg, height - top, z + leg));
}

} // namespace

Scene lamp_room() {
    Scene scene;
    scene.name = "lamp-room";
    add_gray_room(scene);
    // The shade is a closed solid: an outer and an inner cone, and a rim at either end.
    const vec3 foot(0.1f, 0.55f, -0.2f);
    constexpr float low = 0.32f, high = 0.18f, height = 0.35f, wall = 0.01f;
    const float slope = std::hypot(low - high, height), out = height / slope, up = (low - high) / slope;
    Mesh& shade = add_object(scene, lambertian("shade", {0.7f, 0.65f, 0.55f}));
    add_revolved(shade, foot, {{low, 0, out, up}, {high, height, out, up}}, 64);
    add_revolved(shade, foot, {{high, height, 0, 1}, {high - wall, height, 0, 1}}, 64);
    add_revolved(shade, foot, {{high - wall, height, -out, -up}, {low - wall, 0, -out, -up}}, 64);
    add_revolved(shade, foot, {{low - wall, 0, 0, -1}, {low, 0, 0, -1}}, 64);
    add_cylinder(add_object(scene, lambertian("stand", vec3(0.2f))), {0.1f, 0, -0.2f}, 0.02f, 0.6f, 24);
    add_sphere(add_object(scene, lambertian("bulb", vec3(0), vec3(60.0f, 50.0f, 35.0f))), {0.1f, 0.7f, -0.2f},
               0.05f, 24, 12);
    scene.cameras = {camera_at({0, 1, 4.6f}, {0, 0.9f, 0}, 28.0f)};
    return scene;
}

Scene classroom() {
    Scene scene;
    scene.name = "classroom";
    constexpr float width = 6.0f, height = 3.0f, length = 8.0f, thickness = 0.2f;
    add_shell(scene, width, height, length, thickness);
    add_window_wall(scene, -thickness, thickness, length, height);
    add_slab(scene, "blackboard", {0.03f, 0.06f, 0.04f}, {1.5f, 1.0f, 0.0f}, {4.5f, 2.2f, 0.03f});
    // Two meshes, filled after both are in the scene's list, which moves them as it grows.
    add_object(scene, lambertian("desks", {0.6f, 0.45f, 0.25f}));
    Mesh& chairs = add_object(scene, lambertian("chairs", {0.15f, 0.25f, 0.45f}));
    Mesh& desks = scene.meshes[scene.meshes.size() - 2];
    for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 3; ++column) {
            const vec3 at(0.6f + 1.8f * float(column), 0, 1.6f + 1.4f * float(row));
            add_table(desks, at, 1.2f, 0.5f, 0.72f);
            add_table(chairs, at + vec3(0.4f, 0, 0.55f), 0.4f, 0.4f, 0.44f);
            add_box(chairs, at + vec3(0.4f, 0.44f, 0.92f), at + vec3(0.8f, 0.85f, 0.95f));
        }
    add_daylight(scene, {0.75f, -0.6f, -0.25f});
    scene.cameras = {camera_at({4.8f, 1.7f, 7.6f}, {2.2f, 0.9f, 2.0f}, 52.0f)};
    return scene;
}

Scene glazed_room() {
    Scene scene;
    scene.name = "glazed-room";
    constexpr float width = 5.0f, height = 2.8f, length = 6.0f, thickness = 0.2f;
    add_shell(scene, width, height, length, thickness);
    add_window_wall(scene, -thickness, thickness, length, height);
    Material pane = glass("pane", 1.5f);
    pane.thin = true;
    Mesh& panes = add_object(scene, pane);
    for (float z = 1.0f; z < length; z += 2.0f)
        add_quad(panes, {-0.5f * thickness, 0.9f, z}, {0, 1.4f, 0}, {0, 0, 1.0f});
    Mesh& sofa = add_object(scene, lambertian("sofa", {0.2f, 0.35f, 0.3f}));
    add_box(sofa, {2.6f, 0, 1.0f}, {4.6f, 0.42f, 1.9f});
    add_box(sofa, {2.6f, 0.42f, 1.0f}, {4.6f, 0.85f, 1.2f});
    add_table(add_object(scene, lambertian("table", wood)), {1.4f, 0, 2.6f}, 1.1f, 0.7f, 0.45f);
    add_daylight(scene, {0.7f, -0.65f, 0.2f});
    scene.cameras = {camera_at({4.4f, 1.6f, 5.6f}, {1.6f, 0.9f, 1.6f}, 58.0f)};
    return scene;
}

Scene torus_in_glass() {
    Scene scene;
    scene.name = "torus-in-glass";
    add_quad_object(scene, lambertian("floor", vec3(0.6f)), {-3, 0, -3}, {0, 0, 6}, {6, 0, 0});
    add_quad_object(scene, lambertian("wall", {0.5f, 0.55f, 0.65f}), {-3, 0, -1.6f}, {6, 0, 0}, {0, 3, 0});
    add_torus(add_object(scene, lambertian("torus", {0.7f, 0.3f, 0.2f})), {0, 0.5f, 0}, 0.25f, 0.1f, 64, 32);
    add_box(add_specular_object(scene, glass("block", 1.5f)), {-0.5f, 0.02f, -0.5f}, {0.5f, 1.0f, 0.5f});
    scene.lights = {spot_light({1.4f, 2.6f, 1.2f}, {0, 0.4f, 0}, 30.0f, 25.0f, 40.0f)};
    scene.cameras = {camera_at({-1.2f, 1.6f, 3.2f}, {0, 0.45f, 0}, 38.0f)};
    return scene;
}

} // namespace luxel
