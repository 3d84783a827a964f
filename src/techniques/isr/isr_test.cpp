// SPDX-License-Identifier: MIT
// Image-space radiosity on analytic G-buffers: closed forms and invariants. The bound against the reference
// is in tests/.
#include "techniques/isr/gather.h"
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "techniques/isr/gather.h"
#include "techniques/isr/test_frame.h"

namespace luxel {
namespace {

using testing::Analytic;
using testing::corner_form_factor;
using testing::floor_and_wall;
using testing::IsrTestFrame;
using testing::mean_over_block;

constexpr float pi = std::numbers::pi_v<float>;

TEST(Isr, FloorBeforeALitWallReceivesItsFormFactor) {
    constexpr int size = 256;
    IsrTestFrame f(size, size, floor_and_wall);
    auto [radiance, open] =
        f.run({{"samples", "256"}, {"radius", "2"}, {"blur", "0"}, {"resolution", "full"}});
    // The visible wall is the rectangle x in [-2, 2], y in [0, 3]; compare along the image's middle column.
    for (int y : {205, 220, 240}) {
        int x = size / 2 - 4;
        double to_wall = 2.0 + testing::floor_z(f.frame.view, float(y) + 4.0f);
        double expected = 2 * corner_form_factor(3, 2, to_wall); // E/pi = F for a wall of radiance 1
        EXPECT_NEAR(mean_over_block(radiance, x, y, 8) / expected, 1.0, 0.03) << "distance " << to_wall;
    }
}

TEST(Isr, HalfResolutionAgreesWithFull) {
    constexpr int size = 256;
    IsrTestFrame f(size, size, floor_and_wall);
    auto [full, o1] = f.run({{"samples", "256"}, {"radius", "2"}, {"resolution", "full"}});
    auto [half, o2] = f.run({{"samples", "256"}, {"radius", "2"}, {"resolution", "half"}});
    for (int y : {205, 220, 240})
        EXPECT_NEAR(mean_over_block(half, 100, y, 8) / mean_over_block(full, 100, y, 8), 1.0, 0.03);
}

TEST(Isr, PlaneSendsNothingToItselfAndStaysOpen) {
    IsrTestFrame f(128, 96, [](glm::vec3 o, glm::vec3 ray) -> Analytic {
        if (ray.y >= 0) return {};
        return {-o.y / ray.y, {0, 1, 0}, glm::vec3(0.8f), glm::vec3(1)};
    });
    auto [radiance, open] = f.run({});
    for (float value : radiance.data) EXPECT_NEAR(value, 0.0f, 1e-4f);
    for (float value : open.data) EXPECT_NEAR(value, 1.0f, 1e-4f);
}

TEST(Isr, SecondBounceInACornerOfEqualWallsFollowsTheFirst) {
    // Both surfaces lit and reflecting: more bounces only add light, and less each time.
    IsrTestFrame f(128, 128, [](glm::vec3 o, glm::vec3 ray) {
        Analytic a = floor_and_wall(o, ray);
        a.albedo = glm::vec3(0.5f), a.radiance = glm::vec3(1);
        return a;
    });
    auto [one, o1] = f.run({{"bounces", "1"}});
    auto [two, o2] = f.run({{"bounces", "2"}});
    auto [three, o3] = f.run({{"bounces", "3"}});
    double first = 0, second = 0, third = 0;
    for (std::size_t i = 0; i < one.data.size(); ++i) {
        first += one.data[i], second += two.data[i] - one.data[i], third += three.data[i] - two.data[i];
        EXPECT_GE(two.data[i], one.data[i] - 1e-5f);
    }
    EXPECT_GT(second, 0.0);
    EXPECT_LT(second, 0.5 * first);
    EXPECT_LT(third, 0.5 * second);
}

TEST(Isr, IsLinearInTheLight) {
    auto scaled = [](float k) {
        return [k](glm::vec3 o, glm::vec3 ray) {
            Analytic a = floor_and_wall(o, ray);
            a.radiance *= k;
            return a;
        };
    };
    IsrTestFrame one(64, 64, scaled(1)), ten(64, 64, scaled(10));
    Image a = one.run({}).first, b = ten.run({}).first;
    for (std::size_t i = 0; i < a.data.size(); ++i)
        EXPECT_NEAR(b.data[i], 10 * a.data[i], 1e-4f + 1e-4f * b.data[i]);
}

TEST(Isr, ThesisModeDarkensDirectLightByOcclusion) {
    IsrTestFrame f(128, 128, [](glm::vec3 o, glm::vec3 ray) {
        Analytic a = floor_and_wall(o, ray);
        a.albedo = glm::vec3(0.5f), a.radiance = glm::vec3(1);
        return a;
    });
    auto [without, o1] = f.run({{"mode", "thesis"}, {"k_isr", "0"}, {"k_ssao", "0"}});
    auto [occluded, o2] = f.run({{"mode", "thesis"}, {"k_isr", "0"}, {"k_ssao", "1"}});
    double darkest = 0;
    for (std::size_t i = 0; i < without.data.size(); i += 4) {
        EXPECT_EQ(without.data[i], 0.0f);
        EXPECT_LE(occluded.data[i], 0.0f);
        darkest = std::min(darkest, double(occluded.data[i]));
    }
    EXPECT_LT(darkest, -0.01);
}

TEST(IsrTaps, WeightsIntegrateAnInverseSquareExactly) {
    // Taps have density 1/(2 pi r^2 ln(R/r0)), so that the sum of weight/r^2 is the integral of 1/r^2 over
    // the ring.
    double sum = 0;
    for (int i = 0; i < 80; ++i) {
        shared::IsrTap t = shared::log_polar_tap(i, 80, 0.5f, 200.0f, 0.5f, 0.0f);
        sum += t.weight / dot(t.offset, t.offset);
    }
    EXPECT_NEAR(sum, 2 * pi * std::log(400.0), 1e-3);
}

TEST(IsrTaps, PatchesOfAPlaneAddUpToItsArea) {
    // Pixels of a 90 degree view of the plane z = -1 seen at a slant: areas sum to the visible quad's.
    constexpr int n = 200;
    double area = 0;
    glm::vec3 normal = glm::normalize(glm::vec3(0.3f, 0.2f, 1.0f));
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x) {
            glm::vec3 ray{(float(x) + 0.5f) / n * 2 - 1, (float(y) + 0.5f) / n * 2 - 1, -1};
            float z = -1.0f / glm::dot(normal, ray);
            area += glm::length(shared::patch_area_vector(normal, ray, z, 4.0f / (n * n), 0.01f));
        }
    // Corners of the quad where the view's edges meet the plane n.x = -1.
    auto corner = [&](float x, float y) {
        return glm::vec3(x, y, -1) * (-1.0f / glm::dot(normal, glm::vec3(x, y, -1)));
    };
    glm::vec3 a = corner(-1, -1), b = corner(1, -1), c = corner(1, 1), d = corner(-1, 1);
    double expected =
        0.5 * double(glm::length(glm::cross(b - a, c - a)) + glm::length(glm::cross(c - a, d - a)));
    EXPECT_NEAR(area / expected, 1.0, 1e-3);
}

} // namespace
} // namespace luxel
