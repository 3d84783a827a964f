// SPDX-License-Identifier: MIT
// A tree with many small leaves beside a stone: what impostors are made for.
#include <cmath>

#include "scene/procedural.h"
#include "scene/procedural_parts.h"
#include "shared/random.h"

namespace luxel {
namespace {

using namespace procedural;

constexpr glm::vec3 crown_center(0.0f, 1.5f, 0.0f);
constexpr float crown_radius = 0.6f;  // meters
constexpr shared::uint blocks = 6;    // of leaves, which can be impostors of their own
constexpr shared::uint leaves = 400;  // in each
constexpr float leaf_length = 0.07f;  // meters
constexpr float branch_width = 0.03f; // meters

// Uniform numbers that depend on their keys alone.
float random_at(shared::uint a, shared::uint b) { return shared::uniform_float(shared::hash2(a, b)); }
glm::vec3 random_direction(shared::uint key) {
    const float z = 2.0f * random_at(key, 0) - 1.0f, phi = 2.0f * shared::PI * random_at(key, 1);
    const float r = std::sqrt(std::max(1.0f - z * z, 0.0f));
    return {r * std::cos(phi), r * std::sin(phi), z};
}

struct Across {
    glm::vec3 u, v;
};
Across across(glm::vec3 n) {
    const glm::vec3 u =
        glm::normalize(glm::cross(n, std::abs(n.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0)));
    return {u, glm::cross(n, u)};
}

// Blocks are spread about the crown, one of them on top.
glm::vec3 block_center(shared::uint block) {
    if (block == 0) return crown_center + glm::vec3(0, 0.5f * crown_radius, 0);
    const float phi = 2.0f * shared::PI * float(block) / float(blocks - 1);
    return crown_center + glm::vec3(std::cos(phi), -0.2f, std::sin(phi)) * (0.5f * crown_radius);
}

// Square prism without ends.
void add_branch(Mesh& mesh, glm::vec3 from, glm::vec3 to, float width) {
    const glm::vec3 along = to - from;
    const auto [u, v] = across(glm::normalize(along));
    const glm::vec3 corner[4] = {-u - v, u - v, u + v, v - u};
    for (int i = 0; i < 4; ++i) {
        const glm::vec3 a = corner[i] * (0.5f * width), b = corner[(i + 1) % 4] * (0.5f * width);
        add_quad(mesh, from + a, b - a, along);
    }
}

// Leaves fill a ball; each is a square that hangs in a random direction.
void add_leaves(Mesh& mesh, shared::uint block) {
    for (shared::uint i = 0; i < leaves; ++i) {
        const shared::uint key = shared::hash2(block, i);
        const float radius = 0.55f * crown_radius * std::cbrt(random_at(key, 2));
        const glm::vec3 at = block_center(block) + random_direction(shared::hash2(key, 3)) * radius;
        const auto [u, v] = across(random_direction(shared::hash2(key, 4)));
        add_quad(mesh, at - (u + v) * (0.5f * leaf_length), u * leaf_length, v * leaf_length);
    }
}

} // namespace

Scene tree() {
    Scene scene;
    scene.name = "tree";
    add_quad_object(scene, lambertian("ground", {0.45f, 0.4f, 0.3f}), {-3, 0, 3}, {6, 0, 0}, {0, 0, -6});

    Mesh& wood = add_object(scene, lambertian("wood", {0.3f, 0.2f, 0.12f}));
    add_cylinder(wood, {0, 0, 0}, 0.06f, 1.3f, 24);
    for (shared::uint block = 0; block < blocks; ++block)
        add_branch(wood, {0, 1.1f, 0}, crown_center + (block_center(block) - crown_center) * 1.9f,
                   branch_width);
    for (shared::uint block = 0; block < blocks; ++block) {
        const float shade = 0.7f + 0.3f * random_at(block, 5);
        Material green =
            lambertian("leaves " + std::to_string(block + 1), glm::vec3(0.2f, 0.5f, 0.1f) * shade);
        green.double_sided = true;
        add_leaves(add_object(scene, green), block);
    }
    add_sphere(add_object(scene, lambertian("stone", {0.5f, 0.5f, 0.55f})), {0.55f, 0.2f, 0.6f}, 0.3f, 96,
               48);

    shared::Light sun{};
    sun.type = shared::LIGHT_DIRECTIONAL;
    sun.direction = glm::normalize(glm::vec3(-0.5f, -0.8f, -0.55f));
    sun.intensity = glm::vec3(4.0f);
    scene.lights = {sun};
    scene.cameras = {camera_at({0.6f, 1.5f, 4.0f}, {0.1f, 1.05f, 0.0f}, 36.0f)};
    return scene;
}

} // namespace luxel
