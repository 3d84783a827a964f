// SPDX-License-Identifier: MIT
// Bounds, counts and the basis of pixel rays.
#include "scene/scene.h"

#include <cmath>

#include <gtest/gtest.h>

#include "scene/procedural.h"

namespace luxel {
namespace {

TEST(Scene, BoundsAndCountsFollowTheInstances) {
    Scene scene = furnace(0.5f);
    scene.instances.push_back(scene.instances[0]);
    scene.instances[1].transform[3] = glm::vec4(10, 0, 0, 1);
    EXPECT_EQ(scene.triangles(), 24u);
    EXPECT_EQ(scene.bounds().least, glm::vec3(-1, -1, -1));
    EXPECT_EQ(scene.bounds().most, glm::vec3(11, 1, 1));
    EXPECT_TRUE(Scene{}.bounds().empty());
}

TEST(Scene, PixelRaysSpanTheFieldOfView) {
    Camera camera;
    camera.forward = glm::normalize(glm::vec3(1, -0.5f, 2));
    camera.yfov = 0.8f;
    const int width = 300, height = 200;
    const CameraBasis basis = camera_basis(camera, width, height);
    const glm::vec3 middle = pixel_direction(basis, width, height, {150, 100});
    const glm::vec3 top = pixel_direction(basis, width, height, {150, 0});
    const glm::vec3 right = pixel_direction(basis, width, height, {300, 100});
    EXPECT_LT(glm::length(middle - camera.forward), 1e-6f);
    EXPECT_NEAR(std::acos(glm::dot(glm::normalize(top), camera.forward)), 0.4f, 1e-5f);
    EXPECT_NEAR(glm::length(right - middle), 1.5f * std::tan(0.4f), 1e-5f);

    // Row 0 is up, the last column to the right, and no direction has lost its depth of 1.
    EXPECT_GT(top.y, middle.y);
    EXPECT_GT(glm::dot(glm::cross(right - middle, top - middle), -camera.forward), 0.0f);
    for (const glm::vec3 d : {top, right}) EXPECT_NEAR(glm::dot(d, camera.forward), 1.0f, 1e-6f);
}

TEST(Scene, LookingAlongUpStillHasABasis) {
    Camera camera;
    for (const glm::vec3 forward : {glm::vec3(0, -1, 0), glm::vec3(0, 1, 0)}) {
        camera.forward = forward;
        const CameraBasis basis = camera_basis(camera, 10, 10);
        EXPECT_NEAR(glm::dot(basis.right, basis.up), 0.0f, 1e-6f);
        EXPECT_NEAR(glm::length(basis.right), std::tan(0.45f), 1e-5f);
    }
}

} // namespace
} // namespace luxel
