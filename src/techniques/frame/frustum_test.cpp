// SPDX-License-Identifier: MIT
#include "techniques/frame/frustum.h"

#include <gtest/gtest.h>

#include "techniques/frame/projection.h"

namespace luxel {
namespace {

// Looks along -z from the origin, 90 degrees on both axes.
shared::ViewParams square_view() {
    Camera camera;
    camera.yfov = glm::radians(90.0f);
    camera.near = 0.5f;
    return view_params(camera, 64, 64);
}

Bounds box_at(glm::vec3 center, float half) {
    Bounds b;
    b.add(center - half), b.add(center + half);
    return b;
}

TEST(Projection, DepthIsReversedAndClipWIsTheDistance) {
    glm::mat4 m = square_view().world_to_clip;
    glm::vec4 near = m * glm::vec4(0, 0, -0.5f, 1), corner = m * glm::vec4(10, 10, -10, 1);
    EXPECT_FLOAT_EQ(near.z / near.w, 1.0f);
    EXPECT_FLOAT_EQ(corner.w, 10.0f);
    EXPECT_FLOAT_EQ(corner.x / corner.w, 1.0f);
    EXPECT_FLOAT_EQ(corner.y / corner.w, 1.0f);
    EXPECT_FLOAT_EQ(corner.z / corner.w, 0.05f);
}

TEST(Projection, OrthographicDepthIsLinear) {
    glm::mat4 m = orthographic_to_clip({{1, 2, 3}, {0, 0, -1}, {2, 0, 0}, {0, 4, 0}}, 1.0f, 5.0f);
    glm::vec4 near = m * glm::vec4(3, 2, 2, 1), far = m * glm::vec4(1, 6, -2, 1),
              middle = m * glm::vec4(1, 2, 0, 1);
    EXPECT_EQ(near, glm::vec4(1, 0, 1, 1));
    EXPECT_EQ(far, glm::vec4(0, 1, 0, 1));
    EXPECT_EQ(middle, glm::vec4(0, 0, 0.5f, 1));
}

TEST(Projection, WorldPositionInvertsTheProjection) {
    Camera camera;
    camera.position = {1, 2, 3};
    camera.forward = glm::normalize(glm::vec3(1, -0.5f, 0.3f));
    shared::ViewParams v = view_params(camera, 320, 200);
    glm::vec3 world = shared::world_position(v, {17.5f, 180.5f}, 7.0f);
    glm::vec4 clip = v.world_to_clip * glm::vec4(world, 1.0f);
    EXPECT_NEAR((clip.x / clip.w * 0.5f + 0.5f) * 320, 17.5f, 1e-3f);
    EXPECT_NEAR((0.5f - clip.y / clip.w * 0.5f) * 200, 180.5f, 1e-3f);
    EXPECT_NEAR(clip.w, 7.0f, 1e-5f);
}

TEST(Frustum, CullsWhatLiesOutside) {
    Frustum f = frustum_of(square_view().world_to_clip);
    EXPECT_TRUE(touches(f, box_at({0, 0, -5}, 1)));
    EXPECT_TRUE(touches(f, box_at({5.5f, 0, -5}, 1))); // across the right plane
    EXPECT_TRUE(touches(f, box_at({0, 0, 0}, 100)));   // around everything
    EXPECT_TRUE(touches(f, box_at({0, 0, -1e6f}, 1))); // there is no far plane
    EXPECT_FALSE(touches(f, box_at({0, 0, 5}, 1)));    // behind
    EXPECT_FALSE(touches(f, box_at({8, 0, -5}, 1)));   // right of it
    EXPECT_FALSE(touches(f, box_at({0, -8, -5}, 1)));  // below
    EXPECT_FALSE(touches(f, box_at({0, 0, 0}, 0.4f))); // before the near plane
    EXPECT_FALSE(touches(f, Bounds{}));
}

TEST(Frustum, CommonCornersBoundWhatIsSeen) {
    Frustum f = frustum_of(square_view().world_to_clip);
    auto hull = [&](const Bounds& box) {
        Bounds b;
        for (glm::vec3 p : common_corners(box, f, glm::vec3(0))) b.add(p);
        return b;
    };
    // Camera inside of the box: a pyramid from the apex to the far side.
    Bounds inside = hull(box_at({0, 0, 0}, 10));
    EXPECT_LT(glm::length(inside.least - glm::vec3(-10)), 1e-4f);
    EXPECT_LT(glm::length(inside.most - glm::vec3(10, 10, 0)), 1e-4f);
    // A box seen whole is its own part; one that is not seen has none.
    Bounds whole = hull(box_at({0, 0, -5}, 1));
    EXPECT_LT(glm::length(whole.least - glm::vec3(-1, -1, -6)), 1e-5f);
    EXPECT_LT(glm::length(whole.most - glm::vec3(1, 1, -4)), 1e-5f);
    EXPECT_TRUE(common_corners(box_at({0, 0, 5}, 1), f, glm::vec3(0)).empty());
}

} // namespace
} // namespace luxel
