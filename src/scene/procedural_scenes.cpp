// SPDX-License-Identifier: MIT
// The procedural scenes: rooms and objects whose every number stands here.
#include <cmath>

#include "scene/procedural.h"
#include "scene/procedural_parts.h"

namespace luxel {
namespace {

using namespace procedural;

// A box that stands on the floor, seen from above: corner, then the two horizontal edges with edge_x x edge_z
// pointing down (-y).
void add_standing_box(Mesh& mesh, glm::vec2 corner, glm::vec2 edge_x, glm::vec2 edge_z, float height) {
    const glm::vec3 o(corner.x, 0, corner.y), x(edge_x.x, 0, edge_x.y), z(edge_z.x, 0, edge_z.y);
    const glm::vec3 y(0, height, 0);
    add_quad(mesh, o, z, y);
    add_quad(mesh, o + x, y, z);
    add_quad(mesh, o, x, z);
    add_quad(mesh, o + y, z, x);
    add_quad(mesh, o, y, x);
    add_quad(mesh, o + z, x, y);
}

// The Cornell box in meters, after the Tungsten example scene (CC0): x to the right, y up, the open side at
// +z.
//   room            x [-1, 1], y [0, 2], z [-1, 1], open toward +z
//   area light      y 1.98, x [-.24, .23], z [-.22, .16], facing down, radiance (17, 12, 4), black
//   short box       .6 high, floor corners listed in cornell()
//   tall box        1.2 high, floor corners listed in cornell()
//   camera          (0, 1, 6.8) toward -z, 19.5 degrees vertical
namespace cornell_table {
constexpr glm::vec3 white{0.725f, 0.71f, 0.68f};
constexpr glm::vec3 red{0.63f, 0.065f, 0.05f};    // left, x = -1
constexpr glm::vec3 green{0.14f, 0.45f, 0.091f};  // right, x = 1
constexpr glm::vec3 radiance{17.0f, 12.0f, 4.0f}; // of the area light
} // namespace cornell_table

} // namespace

Scene furnace(float albedo, float emission) {
    Scene scene;
    scene.name = "furnace";
    Mesh& room = add_object(scene, lambertian("room", glm::vec3(albedo), glm::vec3(emission)));

    // An ordinary box turned inside out: the front faces inward.
    add_box(room, glm::vec3(-1.0f), glm::vec3(1.0f));
    for (glm::vec3& normal : room.normals) normal = -normal;
    for (std::size_t i = 0; i < room.indices.size(); i += 3)
        std::swap(room.indices[i + 1], room.indices[i + 2]);

    scene.cameras = {camera_at(glm::vec3(0.0f), {0, 0, -1}, 60.0f)};
    return scene;
}

Scene cornell() {
    using namespace cornell_table;
    Scene scene;
    scene.name = "cornell";
    add_open_room(scene, lambertian("floor", white), lambertian("ceiling", white),
                  lambertian("back wall", white), lambertian("left wall", red),
                  lambertian("right wall", green));

    // (x, z) of a floor corner and of the two edges that start there.
    add_standing_box(add_object(scene, lambertian("short box", white)), {0.124253f, 0.003105f},
                     {0.579084f, 0.173072f}, {-0.170328f, 0.569902f}, 0.6f);
    add_standing_box(add_object(scene, lambertian("tall box", white)), {-0.720444f, -0.473882f},
                     {0.573551f, -0.199597f}, {0.196458f, 0.564531f}, 1.2f);

    add_quad_object(scene, lambertian("light", glm::vec3(0.0f), radiance), {-0.24f, 1.98f, -0.22f},
                    {0.47f, 0, 0}, {0, 0, 0.38f});
    scene.cameras = {camera_at({0, 1, 6.8f}, {0, 1, 0}, 19.5f)};
    return scene;
}

Scene shapes(ShapesLight light) {
    Scene scene;
    add_quad_object(scene, lambertian("floor", glm::vec3(0.6f)), {-4, 0, -4}, {0, 0, 8}, {8, 0, 0});

    // Neighbors touch each other's light but not each other: about a meter apart, the odd ones further back.
    add_box(add_object(scene, lambertian("cube", {0.65f, 0.12f, 0.1f})), {-2.4f, 0.0f, -0.4f},
            {-1.6f, 0.8f, 0.4f});
    add_cylinder(add_object(scene, lambertian("cylinder", {0.12f, 0.45f, 0.16f})), {-1.0f, 0.0f, -0.7f}, 0.4f,
                 1.1f, 48);
    add_sphere(add_object(scene, lambertian("sphere", {0.15f, 0.25f, 0.65f})), {0.0f, 0.5f, 0.4f}, 0.5f, 48,
               24);
    add_cone(add_object(scene, lambertian("cone", {0.7f, 0.55f, 0.12f})), {1.0f, 0.0f, -0.7f}, 0.45f, 1.1f,
             48);
    add_torus(add_object(scene, lambertian("torus", {0.5f, 0.18f, 0.55f})), {2.0f, 0.18f, 0.3f}, 0.42f, 0.18f,
              48, 24);
    scene.cameras = {camera_at({0, 2.6f, 5.6f}, {0, 0.35f, -0.1f}, 42.0f)};

    // All three send about 3 W/m2 to a plane that faces them in the middle of the floor.
    shared::Light lamp{};
    lamp.position = {1.2f, 3.2f, 2.0f};
    lamp.direction = glm::normalize(-lamp.position);
    switch (light) {
    case ShapesLight::point:
        scene.name = "shapes-point", lamp.type = shared::LIGHT_POINT, lamp.intensity = glm::vec3(50.0f);
        break;
    case ShapesLight::spot:
        scene.name = "shapes-spot", lamp.type = shared::LIGHT_SPOT, lamp.intensity = glm::vec3(50.0f);
        lamp.inner = shared::versine(radians(15.0f)), lamp.outer = shared::versine(radians(35.0f));
        break;
    case ShapesLight::directional:
        scene.name = "shapes-directional", lamp.type = shared::LIGHT_DIRECTIONAL;
        lamp.intensity = glm::vec3(3.0f);
        break;
    }
    scene.lights = {lamp};
    return scene;
}

Scene sphere_in_box() {
    Scene scene;
    scene.name = "sphere-in-box";
    add_open_room(scene, lambertian("floor", glm::vec3(0.7f)), lambertian("ceiling", {0.7f, 0.7f, 0.2f}),
                  lambertian("back wall", {0.15f, 0.2f, 0.6f}),
                  lambertian("left wall", {0.63f, 0.065f, 0.05f}),
                  lambertian("right wall", {0.14f, 0.45f, 0.091f}));
    add_sphere(add_object(scene, lambertian("sphere", glm::vec3(0.7f))), {0.0f, 0.9f, 0.0f}, 0.5f, 64, 32);

    shared::Light lamp{};
    lamp.type = shared::LIGHT_POINT;
    lamp.position = {0.0f, 1.8f, 0.5f};
    lamp.intensity = glm::vec3(3.0f);
    scene.lights = {lamp};
    scene.cameras = {camera_at({0, 1, 4.5f}, {0, 1, 0}, 32.0f)};
    return scene;
}

} // namespace luxel
