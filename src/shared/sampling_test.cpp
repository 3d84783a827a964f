// SPDX-License-Identifier: MIT
// Each warp against the density it claims: chi-squared over bins of the sphere, at the 99.9 % level.
#include "shared/sampling.h"

#include <cmath>
#include <functional>
#include <vector>

#include <gtest/gtest.h>

#include "shared/brdf.h"
#include "shared/random.h"

namespace luxel::shared {
namespace {

constexpr int rows = 12, columns = 24, samples = 200000;

// 99.9 % quantile of chi-squared [Wilson1931].
double chi_squared_limit(int freedom) {
    double k = 2.0 / (9.0 * freedom);
    return freedom * std::pow(1.0 - k + 3.0902 * std::sqrt(k), 3.0);
}

vec3 direction(double z, double phi) {
    double r = std::sqrt(std::max(0.0, 1.0 - z * z));
    return vec3(float(r * std::cos(phi)), float(r * std::sin(phi)), float(z));
}

// Bins uniform in z and azimuth; the expected count is the density integrated by the midpoint rule.
void expect_distributed(const std::function<vec3(vec2)>& sample, const std::function<double(vec3)>& pdf) {
    std::vector<double> observed(rows * columns, 0.0), expected(rows * columns, 0.0);
    for (uint i = 0; i < uint(samples); ++i) {
        vec3 w = sample({uniform_float(hash2(i, 11u)), uniform_float(hash2(i, 12u))});
        ASSERT_NEAR(length(w), 1.0f, 1e-4f);
        int row = std::min(int((double(w.z) + 1.0) * 0.5 * rows), rows - 1);
        double turn = std::atan2(double(w.y), double(w.x)) / (2.0 * double(PI));
        int column = std::min(int((turn - std::floor(turn)) * columns), columns - 1);
        observed[std::size_t(row * columns + column)] += 1.0;
    }
    const int fine = 32;
    const double cell = 2.0 / (rows * fine) * 2.0 * double(PI) / (columns * fine);
    for (int row = 0; row < rows * fine; ++row)
        for (int column = 0; column < columns * fine; ++column) {
            vec3 w = direction((row + 0.5) * 2.0 / (rows * fine) - 1.0,
                               (column + 0.5) * 2.0 * double(PI) / (columns * fine));
            expected[std::size_t(row / fine * columns + column / fine)] += pdf(w) * cell * samples;
        }

    // Rare bins are pooled, so that every term is nearly Gaussian.
    double chi = 0.0, pooled_observed = 0.0, pooled_expected = 0.0;
    int terms = 0;
    for (std::size_t i = 0; i < observed.size(); ++i) {
        if (expected[i] < 10.0) {
            pooled_observed += observed[i], pooled_expected += expected[i];
            continue;
        }
        chi += (observed[i] - expected[i]) * (observed[i] - expected[i]) / expected[i];
        ++terms;
    }
    if (pooled_expected >= 10.0)
        chi += (pooled_observed - pooled_expected) * (pooled_observed - pooled_expected) / pooled_expected,
            ++terms;
    else
        EXPECT_LT(pooled_observed, 40.0) << "samples where the density is zero";
    EXPECT_LT(chi, chi_squared_limit(terms - 1)) << terms << " bins";
}

TEST(Sampling, FrameIsOrthonormalAndRightHanded) {
    for (uint i = 0; i < 1000; ++i) {
        vec3 n = sample_sphere({uniform_float(hash2(i, 1u)), uniform_float(hash2(i, 2u))});
        mat3 f = frame_around(n);
        EXPECT_NEAR(dot(f[0], f[1]), 0.0f, 1e-5f);
        EXPECT_NEAR(dot(f[0], n), 0.0f, 1e-5f);
        EXPECT_NEAR(length(cross(f[0], f[1]) - n), 0.0f, 1e-5f);
    }
    EXPECT_NEAR(
        length(cross(frame_around(vec3(0, 0, -1))[0], frame_around(vec3(0, 0, -1))[1]) - vec3(0, 0, -1)),
        0.0f, 1e-6f);
}

TEST(Sampling, SphereIsUniform) {
    expect_distributed(sample_sphere, [](vec3) { return 1.0 / (4.0 * double(PI)); });
}

TEST(Sampling, HemisphereFollowsTheCosine) {
    expect_distributed(sample_cosine_hemisphere,
                       [](vec3 w) { return std::max(double(w.z), 0.0) / double(PI); });
}

TEST(Sampling, DiscIsUniform) {
    // Lifted to the hemisphere, a uniform disc is cosine distributed; here the disc itself, by rings and
    // sectors.
    std::vector<int> counts(64, 0);
    for (uint i = 0; i < 64000; ++i) {
        vec2 p = sample_disc({uniform_float(hash2(i, 5u)), uniform_float(hash2(i, 6u))});
        ASSERT_LE(dot(p, p), 1.0001f);
        int ring = std::min(int(dot(p, p) * 8.0f), 7);
        int sector = std::min(int((std::atan2(p.y, p.x) / PI + 1.0f) * 4.0f), 7);
        ++counts[std::size_t(ring * 8 + sector)];
    }
    double chi = 0.0;
    for (int c : counts) chi += (c - 1000.0) * (c - 1000.0) / 1000.0;
    EXPECT_LT(chi, chi_squared_limit(63));
}

TEST(Sampling, VisibleNormalsFollowTheirReflectionDensity) {
    for (float alpha : {0.15f, 0.4f, 1.0f})
        for (float z : {0.15f, 0.6f, 1.0f}) {
            vec3 wo = direction(double(z), 0.7);
            expect_distributed(
                [&](vec2 u) { return normalize(reflect(-wo, sample_visible_normal(wo, alpha, u))); },
                [&](vec3 wi) {
                    vec3 n(0, 0, 1), h = normalize(wi + wo);
                    if (h.z <= 0.0f) return 0.0;
                    return double(ggx_reflection_pdf(ggx_d(n, h, alpha), wo.z, alpha));
                });
        }
}

TEST(Sampling, HammersleyFillsEveryElementaryInterval) {
    std::vector<int> counts(16, 0);
    for (uint i = 0; i < 16; ++i) {
        vec2 p = hammersley(i, 16);
        ++counts[std::size_t(int(p.x * 4.0f) * 4 + int(p.y * 4.0f))];
    }
    for (int c : counts) EXPECT_EQ(c, 1);
}

} // namespace
} // namespace luxel::shared
