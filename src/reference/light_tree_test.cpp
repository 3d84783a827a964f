// SPDX-License-Identifier: MIT
// The tree's chances, directions uniform in a triangle's solid angle, and what both do for many lamps.
#include "reference/light_tree.h"

#include <gtest/gtest.h>

#include "reference/path_tracer.h"
#include "reference/spherical_triangle.h"
#include "reference/test_scenes.h"
#include "shared/random.h"

namespace luxel {
namespace {

using namespace testing;
using shared::PI;

float random(shared::uint i, shared::uint k) { return shared::uniform_float(shared::hash2(i, k)); }
glm::vec3 random_point(shared::uint i) { return {random(i, 1), random(i, 2), random(i, 3)}; }

std::vector<EmitterBounds> scattered(std::size_t count) {
    std::vector<EmitterBounds> all;
    for (shared::uint i = 0; i < count; ++i) {
        EmitterBounds e{
            {}, glm::normalize(random_point(i + 7000) - 0.5f), 1.0f, 0.1f + random(i, 9), i % 3 == 0};
        const glm::vec3 p = random_point(i);
        e.box.add(p), e.box.add(p + 0.02f * random_point(i + 5000));
        all.push_back(e);
    }
    return all;
}

// Chances to be drawn are those that are stated, sum to 1, and are 0 only for what cannot send light.
TEST(LightTree, DrawsByTheChancesItStates) {
    const std::vector<EmitterBounds> emitters = scattered(60);
    const LightTree tree(emitters);
    for (shared::uint k = 0; k < 20; ++k) {
        const glm::vec3 p = random_point(k + 100) * 1.6f - 0.3f,
                        n = glm::normalize(random_point(k + 300) - 0.5f);
        double sum = 0.0;
        for (std::size_t i = 0; i < emitters.size(); ++i) {
            const float chance = tree.chance(i, p, n);
            sum += double(chance);
            EXPECT_TRUE(chance > 0.0f || importance(emitters[i], p, n) <= 0.0f) << i;
        }
        const int draws = 20000;
        int dark = 0; // the bound of a part may be positive where those of its emitters are not
        std::vector<int> drawn(emitters.size());
        for (int d = 0; d < draws; ++d) {
            const LightTree::Choice c = tree.choose(p, n, (float(d) + 0.5f) / float(draws));
            if (c.chance > 0.0f) {
                ASSERT_FLOAT_EQ(c.chance, tree.chance(c.emitter, p, n));
                ++drawn[c.emitter];
            } else {
                ++dark;
            }
        }
        EXPECT_NEAR(sum + double(dark) / draws, 1.0, 1e-3);
        for (std::size_t i = 0; i < emitters.size(); ++i)
            EXPECT_NEAR(drawn[i], double(tree.chance(i, p, n)) * draws, 2.0) << i;
    }
}

// A triangle that faces the point and is above its horizon has a positive bound, wherever it is in its box.
TEST(LightTree, BoundsAreZeroOnlyWhereNoLightArrives) {
    for (shared::uint i = 0; i < 2000; ++i) {
        const glm::vec3 a = random_point(i), b = a + 0.3f * (random_point(i + 10000) - 0.5f),
                        c = a + 0.3f * (random_point(i + 20000) - 0.5f);
        EmitterBounds e{{}, glm::normalize(glm::cross(b - a, c - a)), 1.0f, 1.0f, false};
        e.box.add(a), e.box.add(b), e.box.add(c);
        const glm::vec3 p = random_point(i + 30000) * 1.5f - 0.25f,
                        n = glm::normalize(random_point(i + 40000) - 0.5f);
        bool arrives = false;
        for (shared::uint k = 0; k < 16; ++k) {
            glm::vec2 w(random(i, k + 50), random(i, k + 90));
            if (w.x + w.y > 1.0f) w = 1.0f - w;
            const glm::vec3 d = a + (b - a) * w.x + (c - a) * w.y - p;
            arrives = arrives || (glm::dot(d, n) > 1e-3f && glm::dot(d, e.axis) < -1e-3f);
        }
        EXPECT_TRUE(!arrives || importance(e, p, n) > 0.0f) << i;
    }
}

TEST(LightTree, HoldsManyEmittersInOnePlace) {
    const EmitterBounds one = scattered(1)[0];
    const LightTree same(std::vector<EmitterBounds>(5000, one));
    EXPECT_NEAR(same.chance(4321, {3, 3, 3}, {0, 0, 0}) * 5000.0f, 1.0f, 1e-3f);
    EXPECT_EQ(LightTree().choose({}, {0, 1, 0}, 0.5f).chance, 0.0f);
}

TEST(SphericalTriangle, AnOctantIsAnEighthOfTheSphere) {
    EXPECT_NEAR(SphericalTriangle({1, 2, 3}, {3, 2, 3}, {1, 7, 3}, {1, 2, 4}).solid_angle, PI / 2, 1e-6f);
    EXPECT_EQ(SphericalTriangle({0, 0, 0}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}).solid_angle, 0.0f);
    // Far away: area / r^2.
    const float far = SphericalTriangle({0, 0, 1000}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}).solid_angle;
    EXPECT_NEAR(far * 2e6f, 1.0f, 1e-5f);
}

// Uniform: the mean of cosines over the samples is Lambert's formula over the solid angle.
TEST(SphericalTriangle, DirectionsAreUniform) {
    for (float scale : {0.02f, 1.0f, 30.0f}) {
        const glm::vec3 from(0.1f, -0.2f, 0.3f), a = from + glm::vec3(0, 1, 0),
                                                 b = a + scale * glm::vec3(1, 0.1f, 0.2f),
                                                 c = a + scale * glm::vec3(-0.1f, 0.3f, 0.9f);
        const SphericalTriangle t(from, a, b, c);
        const int n = 256;
        glm::dvec3 mean(0.0);
        for (int i = 0; i < n * n; ++i) {
            const glm::vec3 w = t.sample({(float(i % n) + 0.5f) / n, (float(i / n) + 0.5f) / n});
            ASSERT_NEAR(glm::length(w), 1.0f, 1e-5f);
            for (const auto& [p, q] : {std::pair(t.a, t.b), std::pair(t.b, t.c), std::pair(t.c, t.a)})
                ASSERT_GE(glm::dot(glm::cross(p, q), w) * glm::dot(glm::cross(t.a, t.b), t.c), -1e-6f)
                    << "outside";
            mean += glm::dvec3(w) / double(n * n);
        }
        glm::dvec3 exact(0.0); // vector irradiance over the solid angle
        for (const auto& [p, q] : {std::pair(t.a, t.b), std::pair(t.b, t.c), std::pair(t.c, t.a)}) {
            const glm::dvec3 across = glm::cross(glm::dvec3(p), glm::dvec3(q));
            exact += across / glm::length(across) *
                     std::atan2(glm::length(across), glm::dot(glm::dvec3(p), glm::dvec3(q)));
        }
        exact *= 0.5 / double(t.solid_angle) * (glm::dot(exact, glm::dvec3(t.a)) < 0.0 ? -1.0 : 1.0);
        EXPECT_LT(glm::length(mean - exact), 2e-4 * (scale < 0.1f ? 5.0 : 1.0)) << scale;
    }
}

// 400 small lamps below the ceiling of a hall: the variance of direct light is a fraction of what drawing by
// power leaves, that is of one lamp after the other with equal chances.
TEST(LightTree, ManyLampsLightAFloorWithoutMuchNoise) {
    Scene scene;
    add_floor(scene, lambertian(glm::vec3(0.5f)), 40.0f);
    Mesh& lamps = add_mesh(scene, lambertian(glm::vec3(0.0f), glm::vec3(50.0f)));
    for (int i = 0; i < 20; ++i)
        for (int j = 0; j < 20; ++j)
            add_quad(lamps, {float(i) * 2 - 19.05f, 2.5f, float(j) * 2 - 19.05f}, {0.1f, 0, 0}, {0, 0, 0.1f});
    const RayCaster rays(scene);
    const auto request = request_for({"direct"}, camera_on({0.3f, 1.0f, 0.1f}, {0.6f, 0, 0.4f}), 1, 1);
    const int n = 20000;
    const auto moments = [&](auto&& value) {
        double sum = 0, squares = 0;
        for (int s = 0; s < n; ++s) {
            const double v = value(s);
            sum += v, squares += v * v;
        }
        return std::pair(sum / n, squares / n - sum / n * sum / n);
    };
    const PathTracer tracer(rays, request, {.strategy = Strategy::lights_only});
    const auto [mean, variance] = moments([&](int s) { return double(tracer.trace(0, 0, s).direct.g); });

    // By power: any of the 800 triangles alike, and a uniform point of it.
    const std::vector<EmissiveTriangle> all = emissive_triangles(scene);
    const glm::vec3 x(0.6f, 0, 0.4f);
    const auto [by_power_mean, by_power] = moments([&](int s) {
        const shared::uint i = shared::uint(s);
        const EmissiveTriangle& t =
            all[std::min(std::size_t(random(i, 1) * float(all.size())), all.size() - 1)];
        const float root = std::sqrt(random(i, 2)), v = random(i, 3);
        const glm::vec3 d = t.a * (1.0f - root) + t.b * (root * (1.0f - v)) + t.c * (root * v) - x;
        const float r2 = glm::dot(d, d);
        return double(0.5f / PI * 50.0f * d.y * d.y / (r2 * r2) * t.area * float(all.size()));
    });
    EXPECT_NEAR(mean / by_power_mean, 1.0, 4.0 * std::sqrt((variance + by_power) / n) / mean);
    EXPECT_LT(variance, by_power / 12.0) << "the tree costs less than twice the time of a sample";
}

} // namespace
} // namespace luxel
