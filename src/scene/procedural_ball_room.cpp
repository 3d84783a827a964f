// SPDX-License-Identifier: MIT
// A room of six colors with a ball at a chosen distance from its walls.
#include "scene/procedural.h"
#include "scene/procedural_parts.h"
#include "shared/cube.h"

namespace luxel {

using namespace procedural;

namespace {

constexpr float radius = 0.25f;
// Walls +x, -x, +y, -y, +z, -z.
constexpr glm::vec3 colors[6] = {{0.15f, 0.6f, 0.12f}, {0.65f, 0.1f, 0.08f}, {0.7f, 0.7f, 0.65f},
                                 {0.65f, 0.5f, 0.15f}, {0.12f, 0.2f, 0.65f}, {0.5f, 0.12f, 0.5f}};

// Which of +x, -y and +z the ball comes near to.
glm::vec3 ball_center(BallPlace place, float distance) {
    const float near = 1.0f - radius * (1.0f + 2.0f * distance);
    return {near, place == BallPlace::face ? 0.0f : -near, place == BallPlace::corner ? near : 0.0f};
}

void add_wall(Scene& scene, int face, BallLight light) {
    const shared::CubeAxes a = shared::cube_axes(face);
    const glm::vec3 black(0.0f), &color = colors[face];
    const Material material =
        light == BallLight::walls ? lambertian("wall", black, color) : lambertian("wall", color);
    add_quad_object(scene, material, a.forward - a.u - a.v, 2.0f * a.u, 2.0f * a.v);
}

// Eight lamps on the corners of a cube, off the ball wherever it is.
void add_lamps(Scene& scene) {
    for (int i = 0; i < 8; ++i) {
        const glm::vec3 place((i & 1) ? 0.5f : -0.5f, (i & 2) ? 0.5f : -0.5f, (i & 4) ? 0.5f : -0.5f);
        scene.lights.push_back(point_light(place, 0.5f));
    }
}

} // namespace

Scene color_room(BallLight light) {
    Scene scene;
    scene.name = "color-room";
    for (int face = 0; face < 6; ++face) add_wall(scene, face, light);
    if (light == BallLight::lamps) add_lamps(scene);
    scene.cameras = {camera_at({-0.9f, 0.45f, -0.7f}, glm::vec3(0.0f), 50.0f)};
    return scene;
}

Scene ball_room(BallPlace place, float distance, BallLight light) {
    Scene scene = color_room(light);
    scene.name = "ball-room";
    const glm::vec3 center = ball_center(place, distance);
    add_sphere(add_object(scene, lambertian("ball", glm::vec3(0.8f))), center, radius, 96, 48);
    scene.instances.back().role = "dynamic ball";

    // From behind the wall +x, which the near plane leaves out, onto the side of the ball that it lights.
    Camera behind = camera_at({3.0f, center.y, center.z}, center, 16.0f);
    behind.name = "behind", behind.near = 2.001f;
    scene.cameras = {camera_at({-0.9f, 0.45f, -0.7f}, center, 50.0f), behind};
    return scene;
}

} // namespace luxel
