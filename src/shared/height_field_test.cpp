// SPDX-License-Identifier: MIT
// Searches of a height field against where the ray meets it exactly.
#include "shared/height_field.h"

#include <cmath>

#include <gtest/gtest.h>

#include "shared/random.h"

namespace luxel::shared {
namespace {

HeightField plane(float height, vec2 slope) {
    return {{64, 64}, [=](vec2 uv) { return height + dot(slope, uv); }};
}

// Bumps between 0 and 1, no two alike.
HeightField bumps(float phase) {
    return {{256, 256}, [=](vec2 uv) {
                return 0.5f + 0.25f * std::sin(9.0f * uv.x + phase) + 0.25f * std::sin(7.0f * uv.y - phase);
            }};
}

// The first crossing, by steps that no bump above fits between and 40 halvings.
float exact_hit(const HeightField& field, HeightRay ray) {
    HeightInterval i = linear_search(field, ray, 20000);
    for (int k = 0; k < 40; ++k) i = narrowed(field, ray, i, middle(i));
    return middle(i);
}

HeightSearch parallax(uint mode, int steps = 1) { return {.parallax_steps = steps, .parallax_mode = mode}; }
HeightSearch relief(int linear, int halvings) { return {.linear_steps = linear, .binary_steps = halvings}; }
HeightSearch occlusion(int linear, int secants) {
    return {.linear_steps = linear, .secant_steps = secants, .interpolates = 1.0f};
}
const HeightSearch all_searches[] = {parallax(PARALLAX_PLAIN),
                                     parallax(PARALLAX_OFFSET_LIMIT),
                                     parallax(PARALLAX_SLOPE),
                                     parallax(PARALLAX_ITERATED, 4),
                                     relief(1, 8),
                                     occlusion(1, 4),
                                     relief(16, 5),
                                     occlusion(16, 1)};

std::vector<HeightRay> rays(int count, float steepest) {
    std::vector<HeightRay> all;
    for (int i = 0; i < count; ++i) {
        const float a = 2.4f * float(i), length = steepest * (float(i) + 0.5f) / float(count);
        all.push_back({{0.37f * float(i), 0.11f * float(i)},
                       vec2(std::cos(a), std::sin(a)) * length,
                       1.0f / std::sqrt(1.0f + length * length)});
    }
    return all;
}

double mean_error(const HeightSearch& search, float steepest) {
    double sum = 0;
    const std::vector<HeightRay> all = rays(200, steepest);
    for (std::size_t i = 0; i < all.size(); ++i) {
        const HeightField field = bumps(0.7f * float(i));
        sum += double(std::abs(search_height(field, all[i], search) - exact_hit(field, all[i])));
    }
    return sum / double(all.size());
}

TEST(HeightSearch, StaysOnAFieldThatLiesOnThePolygon) {
    for (const HeightSearch& search : all_searches)
        for (const HeightRay& ray : rays(20, 3))
            EXPECT_EQ(search_height(plane(1, {0, 0}), ray, search), 0.0f);
}

TEST(HeightSearch, MeetsAConstantHeightAtItsDepth) {
    for (const HeightRay& ray : rays(20, 3)) {
        const HeightField field = plane(0.3f, {0, 0});
        for (uint mode : {PARALLAX_PLAIN, PARALLAX_SLOPE, PARALLAX_ITERATED})
            EXPECT_NEAR(search_height(field, ray, parallax(mode)), 0.7f, 1e-6f);
        // The limit is that of a ray which goes straight down: never farther aside than deep [Welsh2004].
        EXPECT_NEAR(search_height(field, ray, parallax(PARALLAX_OFFSET_LIMIT)), 0.7f * ray.cosine, 1e-6f);
        EXPECT_NEAR(search_height(field, ray, occlusion(1, 0)), 0.7f, 1e-6f);
        EXPECT_NEAR(search_height(field, ray, relief(1, 10)), 0.7f, std::exp2(-11.0f));
        EXPECT_NEAR(search_height(field, ray, relief(16, 6)), 0.7f, std::exp2(-11.0f));
    }
}

TEST(HeightSearch, MeetsAnInclinedPlaneExactly) {
    // t = 1 - h - s.(uv + slope t)
    const vec2 incline(0.08f, -0.05f);
    for (const HeightRay& ray : rays(40, 2)) {
        const HeightRay near_origin{ray.uv * 0.1f, ray.slope, ray.cosine};
        const HeightField field = plane(0.5f, incline);
        const float t = (0.5f - dot(incline, near_origin.uv)) / (1.0f + dot(incline, ray.slope));
        ASSERT_GT(t, 0.0f);
        ASSERT_LT(t, 1.0f);
        EXPECT_NEAR(search_height(field, near_origin, parallax(PARALLAX_SLOPE)), t, 2e-5f);
        EXPECT_NEAR(search_height(field, near_origin, occlusion(1, 0)), t, 2e-6f);
        EXPECT_NEAR(search_height(field, near_origin, occlusion(7, 1)), t, 2e-6f);
        EXPECT_NEAR(search_height(field, near_origin, relief(1, 16)), t, std::exp2(-17.0f) + 2e-6f);
        EXPECT_NEAR(search_height(field, near_origin, relief(10, 12)), t, 0.1f * std::exp2(-13.0f) + 2e-6f);
    }
}

TEST(HeightSearch, ErrorFallsWithSteps) {
    // Each halving of the linear step halves the error of its middle; secant steps square it on smooth
    // fields.
    double before = 1;
    for (int steps : {8, 16, 32, 64}) {
        const double error = mean_error(relief(steps, 0), 0.3f);
        EXPECT_LT(error, 0.6 * before) << steps;
        before = error;
    }
    EXPECT_LT(mean_error(occlusion(8, 0), 0.3f), 0.2 * mean_error(relief(8, 0), 0.3f));
    EXPECT_LT(mean_error(occlusion(8, 1), 0.3f), 0.2 * mean_error(occlusion(8, 0), 0.3f));
    EXPECT_LT(mean_error(occlusion(8, 2), 0.3f), 0.5 * mean_error(occlusion(8, 1), 0.3f));
    EXPECT_LT(mean_error(relief(8, 8), 0.3f), 0.01 * mean_error(relief(8, 0), 0.3f));
    EXPECT_LT(mean_error(parallax(PARALLAX_ITERATED, 8), 0.1f),
              0.2 * mean_error(parallax(PARALLAX_ITERATED, 1), 0.1f));
}

TEST(HeightSearch, OrdersAsItsGuessesDo) {
    // While a texel's slope holds for the way to the hit, every guess knows more than the one before.
    const double plain = mean_error(parallax(PARALLAX_PLAIN), 0.15f);
    const double slope = mean_error(parallax(PARALLAX_SLOPE), 0.15f);
    const double iterated = mean_error(parallax(PARALLAX_ITERATED, 4), 0.15f);
    EXPECT_LT(slope, 0.5 * plain);
    EXPECT_LT(iterated, 0.5 * slope);

    // Rays that pass over bumps: only a linear search finds the first crossing. The plane through one point
    // is then a worse guess than its height alone.
    const double both = mean_error(occlusion(32, 2), 1.5f);
    EXPECT_GT(mean_error(parallax(PARALLAX_SLOPE), 1.5f), mean_error(parallax(PARALLAX_PLAIN), 1.5f));
    EXPECT_LT(both, 0.05 * mean_error(relief(1, 12), 1.5f));
    EXPECT_LT(both, 0.05 * mean_error(occlusion(1, 8), 1.5f));
    EXPECT_LT(both, 0.05 * mean_error(parallax(PARALLAX_ITERATED, 4), 1.5f));
}

TEST(HeightSearch, IntervalEnclosesACrossing) {
    for (int steps : {1, 3, 16})
        for (const HeightRay& ray : rays(100, 2)) {
            const HeightField field = bumps(ray.uv.x);
            HeightInterval i = linear_search(field, ray, steps);
            for (int k = 0; k < 8; ++k) {
                ASSERT_LE(i.above, i.below);
                ASSERT_LE(height_gap(field, ray, i.above), 0.0f);
                ASSERT_GE(height_gap(field, ray, i.below), 0.0f);
                i = narrowed(field, ray, i, k % 2 ? middle(i) : crossing(i));
            }
        }
}

TEST(TextureAxes, AreTheGradientsOfTheCoordinates) {
    const vec3 edge1(0.3f, 1.0f, -0.2f), edge2(-0.7f, 0.1f, 0.5f);
    const vec2 uv1(0.4f, -0.3f), uv2(0.2f, 0.9f);
    const TextureAxes axes = texture_axes(edge1, edge2, uv1, uv2);
    EXPECT_NEAR(dot(axes.u, edge1), uv1.x, 1e-6f);
    EXPECT_NEAR(dot(axes.v, edge1), uv1.y, 1e-6f);
    EXPECT_NEAR(dot(axes.u, edge2), uv2.x, 1e-6f);
    EXPECT_NEAR(dot(axes.v, edge2), uv2.y, 1e-6f);
    EXPECT_NEAR(dot(axes.u, cross(edge1, edge2)), 0.0f, 1e-6f);
}

TEST(ReliefNormal, IsThatOfTheDisplacedPlane) {
    // A plane y = 0 with u = x / 2, v = -z: height h = 0.1 u + 0.2 v, 3 m deep.
    const TextureAxes axes = texture_axes({1, 0, 0}, {0, 0, 1}, {0.5f, 0}, {0, -1});
    const vec2 gradient = height_gradient(plane(0.5f, {0.1f, 0.2f}), {0.3f, 0.4f});
    const vec3 n = relief_normal({0, 1, 0}, gradient, axes, 3.0f);
    const vec3 expected = normalize(vec3(-3.0f * 0.05f, 1.0f, 3.0f * 0.2f));
    EXPECT_LT(length(n - expected), 1e-5f);
    EXPECT_EQ(relief_normal({0, 1, 0}, vec2(0.0f), axes, 3.0f), vec3(0, 1, 0));
}

} // namespace
} // namespace luxel::shared
