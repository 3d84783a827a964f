// SPDX-License-Identifier: MIT
#include "shared/thin_sheet.h"

#include <gtest/gtest.h>

namespace luxel::shared {
namespace {

TEST(ThinSheet, PassesWhatItsFrontLeaves) {
    const vec3 tint(0.9f, 0.5f, 0.2f);
    const vec3 straight = thin_transmittance(1.0f, 1.5f, tint);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(straight[c], 0.96f * tint[c], 1e-6f);
    EXPECT_EQ(thin_transmittance(-1.0f, 1.5f, tint), straight) << "the same from behind";
    EXPECT_NEAR(thin_transmittance(0.0f, 1.5f, tint).r, 0.0f, 1e-6f) << "grazing light is reflected";
    EXPECT_NEAR(thin_transmittance(0.3f, 1.0f, tint).g, tint.g, 1e-6f) << "no interface";
}

TEST(ThinSheet, SpecularScalesWhatTheInterfaceReflects) {
    const vec3 white(1.0f);
    EXPECT_NEAR(thin_transmittance(1.0f, 1.5f, vec3(0.5f, 0.0f, 2.0f), white).r, 0.98f, 1e-6f);
    EXPECT_NEAR(thin_transmittance(1.0f, 1.5f, vec3(0.5f, 0.0f, 2.0f), white).g, 1.0f, 1e-6f);
    EXPECT_NEAR(thin_transmittance(1.0f, 1.5f, vec3(0.5f, 0.0f, 2.0f), white).b, 0.92f, 1e-6f);
    EXPECT_EQ(interface_reflectance(0.1f, 1.0f / 1.5f, vec3(0.0f)), vec3(1.0f)) << "total reflection stays";
}

} // namespace
} // namespace luxel::shared
