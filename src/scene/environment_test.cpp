// SPDX-License-Identifier: MIT
// Environment maps: the stated mapping, and the sampler against its own density and against chi-squared.
#include "scene/environment.h"

#include <cmath>

#include <gtest/gtest.h>

#include "shared/random.h"
#include "shared/sampling.h"

namespace luxel {
namespace {

// Smooth sky with a strong lamp of one texel, a black band and a rotation.
Environment test_environment(int width, int height) {
    Environment environment;
    environment.radiance = Image(width, height, 3);
    environment.rotation = 0.7f;
    environment.scale = 2.0f;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const float v = 0.2f + float(x % 7) * 0.1f + float(y) / float(height);
            environment.radiance.set_rgb(
                x, y, y == height / 2 ? glm::vec3(0) : glm::vec3(v, v * 0.5f, 1.0f - 0.5f * v));
        }
    environment.radiance.set_rgb(width / 3, height / 4, glm::vec3(40.0f));
    return environment;
}

glm::vec2 random_point(std::uint32_t i) {
    return {shared::uniform_float(shared::hash2(i, 1)), shared::uniform_float(shared::hash2(i, 2))};
}

TEST(Environment, MapsDirectionsAsStated) {
    Environment environment;
    environment.radiance = Image(4, 2, 3);
    for (int y = 0; y < 2; ++y)
        for (int x = 0; x < 4; ++x) environment.radiance.set_rgb(x, y, glm::vec3(float(y * 4 + x)));

    // Columns from -z - 180 degrees to the right: the borders of the four are +z, -x, -z, +x.
    EXPECT_EQ(evaluate(environment, {-1, 1, 1}).r, 0.0f);
    EXPECT_EQ(evaluate(environment, {-1, 1, -1}).r, 1.0f);
    EXPECT_EQ(evaluate(environment, {1, 1, -1}).r, 2.0f);
    EXPECT_EQ(evaluate(environment, {1, 1, 1}).r, 3.0f);
    EXPECT_EQ(evaluate(environment, {1, -1, -1}).r, 6.0f);

    // A quarter turn counter-clockwise seen from above carries what was at -z, +x to -z, -x.
    environment.rotation = shared::PI / 2.0f;
    environment.scale = 10.0f;
    EXPECT_EQ(evaluate(environment, {-1, 1, -1}).r, 20.0f);
}

TEST(Environment, DirectionsAndCoordinatesAreInverse) {
    const Environment environment = test_environment(32, 16);
    for (std::uint32_t i = 0; i < 1000; ++i) {
        const glm::vec3 d = shared::sample_sphere(random_point(i));
        EXPECT_LT(glm::length(environment_direction(environment, environment_uv(environment, d)) - d), 1e-5f);
    }
}

TEST(Environment, TexelsCoverTheSphere) {
    const Environment environment = test_environment(30, 17);
    double sum = 0;
    for (int y = 0; y < 17; ++y) sum += 30.0 * double(texel_solid_angle(environment, y));
    EXPECT_NEAR(sum, 4.0 * 3.14159265358979, 1e-5);
}

TEST(Environment, SamplesAgreeWithEvaluateAndPdf) {
    const Environment environment = test_environment(64, 32);
    const EnvironmentSampler sampler(environment);
    int differing = 0;
    for (std::uint32_t i = 0; i < 100000; ++i) {
        const EnvironmentSample s = sampler.sample(random_point(i));
        EXPECT_NEAR(glm::length(s.direction), 1.0f, 1e-5f);
        EXPECT_GT(s.pdf, 0.0f);
        differing += s.radiance != evaluate(environment, s.direction) || s.pdf != sampler.pdf(s.direction);
    }
    // Only rounding at a texel's border may name its neighbor: some 1e-6 of a texel's width each.
    EXPECT_LT(differing, 20);
}

// Pearson's statistic over the quarters of each texel, which have equal solid angles.
TEST(Environment, SamplesFollowThePdf) {
    constexpr int width = 24, height = 12, samples = 1000000;
    const Environment environment = test_environment(width, height);
    const EnvironmentSampler sampler(environment);
    const auto row_cosine = [](int y) { return std::cos(shared::PI * float(y) / float(height)); };
    const auto middle = [&](int y) {
        return std::acos((row_cosine(y) + row_cosine(y + 1)) / 2) / shared::PI;
    };

    std::vector<double> seen(width * height * 4);
    for (std::uint32_t i = 0; i < samples; ++i) {
        const glm::vec2 uv = environment_uv(environment, sampler.sample(random_point(i)).direction);
        const int column = std::min(int(uv.x * 2 * width), 2 * width - 1),
                  y = std::min(int(uv.y * height), height - 1);
        seen[std::size_t((2 * y + (uv.y < middle(y) ? 0 : 1)) * 2 * width + column)]++;
    }

    // No sample may fall where the density is zero.
    double chi2 = 0, total = 0;
    int cells = 0;
    for (std::size_t i = 0; i < seen.size(); ++i) {
        const int y = int(i) / (4 * width);
        const glm::vec2 uv((float(i % (2 * width)) + 0.5f) / (2 * width), (float(y) + 0.5f) / height);
        const double p =
            double(sampler.pdf(environment_direction(environment, uv)) * texel_solid_angle(environment, y)) /
            4;
        total += p;
        if (p == 0.0) {
            EXPECT_EQ(seen[i], 0.0);
            continue;
        }
        chi2 += std::pow(seen[i] - p * samples, 2) / (p * samples), ++cells;
    }
    EXPECT_NEAR(total, 1.0, 1e-5);

    // cells - 1 degrees of freedom: that mean, variance twice it; 3.5 standard deviations.
    EXPECT_GT(cells, 1000);
    EXPECT_LT(chi2, cells + 3.5 * std::sqrt(2.0 * cells));
}

TEST(Environment, BlackCannotBeSampled) {
    EXPECT_TRUE(EnvironmentSampler(Environment{}).empty());
    Environment black;
    black.radiance = Image(8, 4, 3);
    EXPECT_TRUE(EnvironmentSampler(black).empty());
    EXPECT_EQ(EnvironmentSampler(black).pdf({0, 1, 0}), 0.0f);
}

} // namespace
} // namespace luxel
