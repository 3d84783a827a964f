// SPDX-License-Identifier: MIT
// Closed forms of the shadow lookups' maths.
#include "techniques/frame/shadow_params.h"

#include <cmath>

#include <gtest/gtest.h>

#include "techniques/frame/esm_params.h"

namespace luxel::shared {
namespace {

TEST(Shadow, EveryDirectionMeetsTheFaceItPointsTo) {
    mat3 axes(1.0f);
    EXPECT_EQ(cube_face(axes, {0.1f, 0.2f, 3.0f}), 0u);
    EXPECT_EQ(cube_face(axes, {2.0f, 0.2f, 1.0f}), 1u);
    EXPECT_EQ(cube_face(axes, {-2.0f, 0.2f, 1.0f}), 2u);
    EXPECT_EQ(cube_face(axes, {0.1f, 0.2f, 0.1f}), 3u);
    EXPECT_EQ(cube_face(axes, {0.1f, -0.2f, 0.1f}), 4u);
    EXPECT_EQ(cube_face(axes, {0.1f, 0.2f, -0.3f}), 5u);
}

// A receiver moved by its offset must be nearer than its own plane at every texel center that the filter
// reads.
TEST(Shadow, OffsetClearsTheReceiversOwnPlane) {
    ShadowView view{};
    view.right = {1, 0, 0}, view.up = {0, 1, 0}; // forward = z
    view.half_texel = vec2(0.01f);
    const float z = 3.0f, reach = shadow_reach(SHADOW_PCF);
    for (float tilt : {0.0f, 0.3f, 0.9f, 1.4f, 1.55f})
        for (float turn : {0.0f, 0.5f, 0.785f, 2.0f}) {
            vec3 n(std::sin(tilt) * std::cos(turn), std::sin(tilt) * std::sin(turn), -std::cos(tilt));
            vec3 point(0.2f, -0.1f, z);
            float plane = dot(n, point);
            vec3 moved = point + n * receiver_offset(view, n, z, reach);
            for (float dx : {-1.0f, 1.0f})
                for (float dy : {-1.0f, 1.0f}) {
                    // The plane's depth where the filter reads, if it lies before the light there.
                    vec3 direction(moved.x / moved.z + reach * 0.01f * dx,
                                   moved.y / moved.z + reach * 0.01f * dy, 1.0f);
                    float along = dot(n, direction);
                    if (along >= 0.0f) continue;
                    EXPECT_GE(plane / along, moved.z * (1.0f - 1e-5f)) << tilt << " " << turn;
                }
        }
}

// The share of a half-plane that the kernel sees falls in a straight line over three texels.
TEST(Shadow, PcfOfAStraightEdgeIsALinearRamp) {
    auto visible = [](float texel) { // lit where the texel's index is below 10
        float corner = std::floor(texel - 0.5f);
        vec4 w = pcf_weights(texel - 0.5f - corner);
        float sum = 0.0f;
        for (int i = 0; i < 4; ++i)
            if (int(corner) + i - 1 < 10) sum += w[i];
        return sum;
    };
    EXPECT_FLOAT_EQ(visible(8.5f), 1.0f);
    EXPECT_FLOAT_EQ(visible(11.5f), 0.0f);
    for (float x = 8.5f; x <= 11.5f; x += 0.0625f) EXPECT_NEAR(visible(x), (11.5f - x) / 3.0f, 1e-5f);
}

TEST(Shadow, EsmIsOneInFrontAndFallsExponentially) {
    EXPECT_FLOAT_EQ(esm_visibility(0.5f, 0.5f, 90.0f, 1.0f), 1.0f);
    EXPECT_FLOAT_EQ(esm_visibility(0.4f, 0.5f, 90.0f, 1.0f), 1.0f);
    EXPECT_NEAR(esm_visibility(0.51f, 0.5f, 90.0f, 1.0f), std::exp(-0.9f), 1e-5f);
    EXPECT_NEAR(esm_visibility(0.51f, 0.5f, 90.0f, 0.5f), std::exp(-0.45f), 1e-5f);
}

// The log-space sum is the logarithm of the plain sum, and does not overflow where that does.
TEST(Shadow, LogSpaceSumMatchesThePlainOne) {
    const float terms[] = {1.0f, -2.0f, 3.0f, 2.5f}, weights[] = {0.1f, 0.4f, 0.2f, 0.3f};
    for (float shift : {0.0f, 500.0f}) {
        LogSum s{-1e30f, 0.0f};
        double plain = 0.0;
        for (int i = 0; i < 4; ++i) {
            s = log_add(s, terms[i] + shift, weights[i]);
            plain += double(weights[i]) * std::exp(double(terms[i]));
        }
        EXPECT_NEAR(s.largest + std::log(s.sum), std::log(plain) + double(shift), 1e-4);
    }
}

TEST(Shadow, LinearDepthUndoesTheReversal) {
    ShadowView perspective{}, orthographic{};
    perspective.near_by_far = 0.001f;
    EXPECT_FLOAT_EQ(linear_light_depth(perspective, 0.01f / 4.0f), 0.4f); // near .01, far 10, z 4
    EXPECT_FLOAT_EQ(linear_light_depth(perspective, 0.0f), 1.0f);
    EXPECT_FLOAT_EQ(linear_light_depth(orthographic, 0.75f), 0.25f);
}

} // namespace
} // namespace luxel::shared
