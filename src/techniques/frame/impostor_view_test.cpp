// SPDX-License-Identifier: MIT
// How wrong billboards are from where they were not drawn.
#include "techniques/frame/impostor_view.h"

#include <random>

#include <gtest/gtest.h>

#include "techniques/frame/projection.h"

namespace luxel {
namespace {

const Bounds box{{-0.5f, -0.3f, -0.7f}, {0.5f, 0.3f, 0.7f}};

shared::ViewParams camera_from(glm::vec3 position) {
    Camera camera;
    camera.position = position, camera.forward = glm::normalize(-position), camera.yfov = 0.8f;
    return view_params(camera, 400, 300);
}

shared::ImpostorCard card_from(glm::vec3 position) {
    const auto view = impostor_view(box, camera_from(position), 64);
    EXPECT_TRUE(view.has_value());
    return card_of(*view, balanced_depth(box, *view));
}

// The redraw is decided by points of the surface: none inside may be displaced farther.
TEST(ImpostorView, NoPointIsDisplacedFartherThanPredicted) {
    std::mt19937 random(5);
    std::uniform_real_distribution<float> unit(-1.0f, 1.0f);
    const auto any = [&] { return glm::vec3(unit(random), unit(random), unit(random)); };
    int views = 0;
    for (int trial = 0; trial < 2000; ++trial) {
        const glm::vec3 eye = glm::normalize(any()) * (2.0f + 3.0f * std::abs(unit(random)));
        const glm::vec3 other = eye + any() * 0.5f;
        if (!impostor_view(box, camera_from(eye), 64)) continue;
        const shared::ImpostorCard card = card_from(eye);
        const float predicted = displacement(box, card, camera_from(other));
        for (int i = 0; i < 50; ++i)
            ASSERT_LE(displacement(box.most * any(), card, camera_from(other)), predicted * 1.001f) << trial;
        ++views;
    }
    EXPECT_GT(views, 1500);
}

TEST(ImpostorView, IsExactFromItsEyeAndWorseFartherAway) {
    const glm::vec3 eye(0.3f, 0.8f, 3.0f);
    const shared::ImpostorCard card = card_from(eye);
    float before = displacement(box, card, camera_from(eye));
    EXPECT_LT(before, 1e-3f);
    for (int step = 1; step <= 20; ++step) {
        const float now = displacement(box, card, camera_from(eye + glm::vec3(0.02f * float(step), 0, 0)));
        EXPECT_GT(now, before);
        before = now;
    }
    EXPECT_GT(before, 10.0f);
}

// A sideways step moves the points of the axis at the box's front and back by the same angle, to first order.
TEST(ImpostorView, ThePlaneIsBalanced) {
    const glm::vec3 eye(0, 0, 3), aside(0.01f, 0, 3);
    const shared::ImpostorCard card = card_from(eye);
    const float front = displacement(glm::vec3(0, 0, 0.7f), card, camera_from(aside));
    const float back = displacement(glm::vec3(0, 0, -0.7f), card, camera_from(aside));
    EXPECT_NEAR(front / back, 1.0f, 0.01f);
    // s |1/z - 1/depth|, in pixels of 2 tan(0.4) / 300.
    const float pixel = 2.0f * std::tan(0.4f) / 300.0f;
    EXPECT_NEAR(front, 0.01f * (1.0f / 2.3f - 1.0f / card.depth) / pixel, 0.01f * front);
}

TEST(ImpostorView, ThereIsNoneFromInsideOrBeside) {
    EXPECT_FALSE(impostor_view(box, camera_from({0.1f, 0.1f, 0.1f}), 64));
    EXPECT_FALSE(impostor_view(box, camera_from({0, 0.35f, 0}), 64));
    EXPECT_TRUE(impostor_view(box, camera_from({0, 3, 0}), 64)); // straight from above
}

// What the view shows at a pixel, the card shows at its place.
TEST(ImpostorView, TheCardIsTheViewsRectangle) {
    const auto view = impostor_view(box, camera_from({1, 2, 3}), 64);
    ASSERT_TRUE(view);
    const shared::ImpostorCard card = card_of(*view, 3.5f);
    for (glm::vec2 at : {glm::vec2(0, 0), glm::vec2(64, 0), glm::vec2(13, 40)}) {
        const glm::vec3 on_card = card.corner + card.edge_u * (at.x / 64.0f) + card.edge_v * (at.y / 64.0f);
        EXPECT_LT(glm::length(on_card - world_position(*view, at, 3.5f)), 1e-5f);
        const glm::vec3 sample = shared::card_sample(card, on_card, 2.9f);
        EXPECT_LT(glm::length(sample - world_position(*view, at, 2.9f)), 1e-5f);
        EXPECT_LT(glm::length(shared::shown_on_card(card, sample) - on_card), 1e-5f);
    }
}

} // namespace
} // namespace luxel
