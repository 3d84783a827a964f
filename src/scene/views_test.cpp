// SPDX-License-Identifier: MIT
// Default cameras frame the scene; drawn views are inside, level and the same for a seed.
#include "scene/views.h"

#include <array>
#include <cmath>
#include <map>

#include <gtest/gtest.h>

#include "core/error.h"
#include "scene/procedural.h"

namespace luxel {
namespace {

TEST(Views, DefaultCamerasFrameTheBounds) {
    const Scene scene = shapes(ShapesLight::point);
    const std::vector<Camera> cameras = default_cameras(scene);
    ASSERT_EQ(cameras.size(), 3u);
    const Bounds bounds = scene.bounds();
    for (const Camera& camera : cameras) {
        EXPECT_GT(camera.position.y, bounds.most.y);
        const CameraBasis basis = camera_basis(camera, 1, 1);
        for (int corner = 0; corner < 8; ++corner) {
            const glm::vec3 p(corner & 1 ? bounds.least.x : bounds.most.x,
                              corner & 2 ? bounds.least.y : bounds.most.y,
                              corner & 4 ? bounds.least.z : bounds.most.z);
            const float depth = glm::dot(p - camera.position, camera.forward);
            EXPECT_GT(depth, camera.near);
            EXPECT_LT(depth, camera.far);
            for (const glm::vec3 axis : {basis.right, basis.up})
                EXPECT_LE(std::abs(glm::dot(p - camera.position, axis)) / glm::dot(axis, axis),
                          depth * 1.0001f);
        }
    }
}

TEST(Views, DrawnViewsAreInsideAndLevel) {
    for (const Scene& scene : {cornell(), furnace(0.5f), sphere_in_box()}) {
        const RayCaster rays(scene);
        const std::vector<Camera> views = draw_views(scene, rays, 6, 42);
        ASSERT_EQ(views.size(), 6u);
        const Bounds bounds = scene.bounds();
        for (const Camera& view : views) {
            EXPECT_TRUE(glm::all(glm::greaterThan(view.position, bounds.least)));
            EXPECT_TRUE(glm::all(glm::lessThan(view.position, bounds.most)));
            EXPECT_NEAR(glm::length(view.forward), 1.0f, 1e-5f);
            EXPECT_LT(std::abs(view.forward.y), 0.35f);

            // Outside of every solid, all that can be seen is front faces or the open side.
            Hit hit;
            if (rays.intersect({view.position, view.forward}, hit)) {
                EXPECT_LT(glm::dot(hit.geometric_normal, view.forward), 0.0f);
            }
        }
    }
}

// A closed solid seen from within shows only back faces, one seen from without leaves most rays empty.
TEST(Views, NoViewInsideASolid) {
    Scene scene;
    scene.name = "solid";
    scene.materials.emplace_back();
    scene.meshes.emplace_back();
    scene.instances.emplace_back();
    add_box(scene.meshes[0], glm::vec3(-1.0f), glm::vec3(1.0f));
    const RayCaster rays(scene);
    try {
        draw_views(scene, rays, 1, 7);
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.fault(), Fault::bad_input);
    }
}

// A room around the lit room: the gap between the shells is a place where no light arrives.
TEST(Views, NoViewInADarkCavity) {
    Scene scene = furnace(0.5f);
    Scene shell = furnace(0.5f, 0.0f);
    shell.materials[0].double_sided = true;
    scene.materials[0].double_sided = true;
    scene.materials[0].emission = glm::vec3(0.0f);
    shell.meshes[0].material = 0;
    shell.instances[0].mesh = 1;
    shell.instances[0].transform = glm::mat4(glm::mat3(3.0f));
    scene.meshes.push_back(shell.meshes[0]);
    scene.instances.push_back(shell.instances[0]);
    shared::Light lamp{};
    lamp.type = shared::LIGHT_POINT;
    lamp.intensity = glm::vec3(1.0f);
    scene.lights = {lamp};

    const RayCaster rays(scene);
    for (const Camera& view : draw_views(scene, rays, 5, 3))
        EXPECT_TRUE(glm::all(glm::lessThan(glm::abs(view.position), glm::vec3(1.0f))));
}

// In the Cornell box a plane is a color and a normal; the probe's grid is coarser than this one.
TEST(Views, NoViewOfOneWallOrOneLamp) {
    const Scene scene = cornell();
    const RayCaster rays(scene);
    for (const Camera& view : draw_views(scene, rays, 8, 21)) {
        std::map<std::array<int, 4>, int> planes;
        int hits = 0, emitters = 0;
        const CameraBasis basis = camera_basis(view, 32, 24);
        for (int i = 0; i < 32 * 24; ++i) {
            Hit hit;
            const glm::vec3 direction =
                pixel_direction(basis, 32, 24, {float(i % 32) + 0.5f, float(i / 32) + 0.5f});
            if (!rays.intersect({view.position, direction}, hit)) continue;
            const Mesh& mesh = scene.meshes[std::size_t(scene.instances[hit.instance].mesh)];
            emitters += scene.materials[std::size_t(mesh.material)].emission != glm::vec3(0.0f);
            const glm::vec3 n = glm::normalize(hit.geometric_normal);
            const float offset = glm::dot(n, view.position + direction * hit.t);
            planes[{int(std::lround(n.x * 50)), int(std::lround(n.y * 50)), int(std::lround(n.z * 50)),
                    int(std::lround(offset * 20))}]++;
            ++hits;
        }
        for (const auto& [plane, count] : planes) EXPECT_LT(count, hits * 0.66);
        EXPECT_LT(emitters, hits * 0.14);
    }
}

TEST(Views, SameSeedSameViews) {
    const Scene scene = cornell();
    const RayCaster rays(scene);
    const std::vector<Camera> a = draw_views(scene, rays, 4, 9), b = draw_views(scene, rays, 4, 9),
                              c = draw_views(scene, rays, 4, 10), longer = draw_views(scene, rays, 8, 9);
    for (std::size_t i = 0; i < a.size(); ++i) {
        EXPECT_EQ(a[i].position, b[i].position);
        EXPECT_EQ(a[i].position, longer[i].position);
        EXPECT_NE(a[i].position, c[i].position);
    }
}

} // namespace
} // namespace luxel
