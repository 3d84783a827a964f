// SPDX-License-Identifier: MIT
// Quads against Lambert's formula in double precision, against numerical integration, and in closed boxes.
#include "shared/form_factor.h"

#include <algorithm>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "shared/sampling.h"
#include "support/box_quads.h"

namespace luxel {
namespace {

using namespace testing;
using glm::vec3;

TEST(FormFactor, IsLambertsIrradianceAnywhereInABox) {
    std::mt19937 random(7);
    int crossing = 0;
    for (int i = 0; i < 1000; ++i) {
        BoxReceiver r = random_receiver(random);
        double expected = 0, found = 0;
        for (int face = 0; face < 6; ++face) {
            shared::Quad q = wall_quad(face, 1, 0, 0, r.position);
            expected += wall_radiance[face] * lambert_irradiance(q, r.normal);
            found += wall_radiance[face] * double(shared::quad_factor_clip(q, r.normal));
            float heights[4] = {dot(q.a, r.normal), dot(q.b, r.normal), dot(q.c, r.normal),
                                dot(q.d, r.normal)};
            crossing +=
                *std::min_element(heights, heights + 4) < 0 && *std::max_element(heights, heights + 4) > 0;
        }
        ASSERT_NEAR(found / expected, 1.0, 1e-4) << i;
    }
    EXPECT_GT(crossing, 1000);
}

// Lambert's formula itself, against the mean over a fine grid of cosine-distributed directions.
TEST(FormFactor, LambertsFormulaIsTheIntegralOverDirections) {
    std::mt19937 random(3);
    for (int i = 0; i < 8; ++i) {
        BoxReceiver r = random_receiver(random);
        constexpr int n = 1000;
        glm::mat3 frame = shared::frame_around(r.normal);
        double integral = 0, expected = 0;
        for (int k = 0; k < n * n; ++k) {
            glm::vec2 u{(float(k % n) + 0.5f) / n, (float(k / n) + 0.5f) / n};
            integral += wall_radiance[wall_met(r.position, frame * shared::sample_cosine_hemisphere(u))];
        }
        integral *= double(shared::PI) / (double(n) * n);
        for (int face = 0; face < 6; ++face)
            expected +=
                wall_radiance[face] * lambert_irradiance(wall_quad(face, 1, 0, 0, r.position), r.normal);
        EXPECT_NEAR(integral / expected, 1.0, 3e-4);
    }
}

// Sum over all texels of a closed box of radiance 1, over pi.
template <class Factor> double closed_box(int m, vec3 position, vec3 n, Factor factor) {
    double sum = 0;
    for (int face = 0; face < 6; ++face)
        for (int i = 0; i < m * m; ++i) sum += double(factor(wall_quad(face, m, i % m, i / m, position), n));
    return sum / double(shared::PI);
}

TEST(FormFactor, ClosedBoxOfRadianceOneGivesOne) {
    std::mt19937 random(5);
    for (int m : {1, 2, 4, 8})
        for (int i = 0; i < 50; ++i) {
            BoxReceiver r = random_receiver(random);
            EXPECT_NEAR(closed_box(m, r.position, r.normal, shared::quad_factor_clip), 1.0, 1e-4);
        }
}

// At the center, where no quad crosses the horizon and the exact sum is 1.
TEST(FormFactor, ThesisFormGivesTooMuch) {
    const vec3 up(0, 1, 0), center(0);
    EXPECT_NEAR(closed_box(2, center, up, shared::quad_factor_thesis), 2.1, 0.05);
    EXPECT_NEAR(closed_box(4, center, up, shared::quad_factor_thesis), 4.6, 0.05);
    EXPECT_NEAR(closed_box(4, center, up, shared::quad_factor_clamp_sum), 1.0, 1e-4); // no quad crosses
    const vec3 aslant = normalize(vec3(0.3f, 1.0f, 0.2f));
    double sum = closed_box(4, center, aslant, shared::quad_factor_clamp_sum);
    EXPECT_LT(sum, 1.0 - 1e-4);
    EXPECT_GT(sum, 0.9);
}

// Two corners above and two below, alternating: the parts above are two separate triangles.
TEST(FormFactor, QuadsOutOfPlaneMayCrossTheHorizonTwice) {
    const vec3 n(0, 0, 1);
    shared::Quad q{{1, -1, 0.5f}, {1, 1, -0.3f}, {-1, 1, 0.5f}, {-1, -1, -0.3f}};
    double whole = 0;
    std::vector<vec3> corners = {q.a, q.b, q.c, q.d};
    // Cut into its two triangles along a-c, each of which lies in a plane.
    for (int first : {0, 2}) {
        vec3 a = corners[std::size_t(first)], b = corners[std::size_t(first + 1)],
             c = corners[std::size_t((first + 2) % 4)];
        whole += lambert_signed({a, b, c}, n);
    }
    EXPECT_NEAR(double(shared::quad_factor_clip(q, n)), whole, 1e-5);
}

TEST(FormFactor, PointsAndDiscsAreFarQuads) {
    // A unit square 20 m above: all forms agree to its size over the distance, squared.
    shared::Quad q{{-0.5f, -0.5f, 20}, {-0.5f, 0.5f, 20}, {0.5f, 0.5f, 20}, {0.5f, -0.5f, 20}};
    const vec3 n(0, 0, 1), center(0, 0, 20), area(0, 0, -1);
    double exact = double(shared::quad_factor_clip({q.d, q.c, q.b, q.a}, n));
    EXPECT_GT(exact, 0);
    EXPECT_NEAR(double(shared::point_factor(center, area, n)) / exact, 1.0, 3e-3);
    EXPECT_NEAR(double(shared::disc_factor(center, area, n)) / exact, 1.0, 3e-3);
    // Near it the point has no bound, the disc that of the hemisphere.
    const vec3 near(0, 0, 0.02f);
    EXPECT_GT(shared::point_factor(near, area, n), 100.0f * shared::PI);
    EXPECT_LT(shared::disc_factor(near, area, n), shared::PI);
}

} // namespace
} // namespace luxel
