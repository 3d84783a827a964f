// SPDX-License-Identifier: MIT
// The sRGB curve and the exposure of a view.
#include "core/image.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

using namespace luxel;

TEST(Image, SrgbCurveHasItsPublishedValuesAndInverts) {
    EXPECT_NEAR(srgb_encode(0.0f), 0.0f, 1e-7);
    EXPECT_NEAR(srgb_encode(1.0f), 1.0f, 1e-6);
    EXPECT_NEAR(srgb_encode(0.2140411f), 0.5f, 1e-5); // IEC 61966-2-1
    for (int i = 0; i <= 255; ++i)
        EXPECT_NEAR(srgb_encode(srgb_decode(float(i) / 255.0f)), float(i) / 255.0f, 1e-6) << i;
}

TEST(Image, DisplayClampsAndMakesNanBlack) {
    Image radiance(4, 1, 1);
    radiance.data = {-1.0f, std::numeric_limits<float>::quiet_NaN(), 8.0f, 0.2140411f / 2};
    const Image shown = display(radiance, 2.0f);
    EXPECT_EQ(shown.data[0], 0.0f);
    EXPECT_EQ(shown.data[1], 0.0f);
    EXPECT_NEAR(shown.data[2], 1.0f, 1e-6);
    EXPECT_NEAR(shown.data[3], 0.5f, 1e-5);
}

TEST(Image, ExposureSendsThePercentileToOne) {
    Image ramp(100, 1, 3);
    for (int x = 0; x < 100; ++x) ramp.set_rgb(x, 0, glm::vec3(float(x + 1)));
    EXPECT_NEAR(exposure_of(ramp, {}) * 98.0f, 1.0f, 1e-5);

    // Only the first ten pixels count: their 98th percentile is the largest.
    Image mask(100, 1, 1);
    for (int x = 0; x < 10; ++x) *mask.at(x, 0) = 1.0f;
    EXPECT_NEAR(exposure_of(ramp, mask) * 10.0f, 1.0f, 1e-5);
}

// A gray picture is exposed as by its luminance; a colored one as if its lamp had been white.
TEST(Image, ExposureDoesNotDependOnTheColorOfTheLamp) {
    for (const glm::vec3 lamp : {glm::vec3(1, 1, 1), glm::vec3(1, 0, 0), glm::vec3(0, 1, 0),
                                 glm::vec3(0, 0, 1), glm::vec3(0.2f, 1, 0.5f)}) {
        Image ramp(100, 1, 3);
        for (int x = 0; x < 100; ++x) ramp.set_rgb(x, 0, lamp * float(x + 1));
        EXPECT_NEAR(exposure_of(ramp, {}) * 98.0f, 1.0f, 1e-5) << lamp.r << lamp.g << lamp.b;
    }
    // Of a block's mean: pixels of three colors that take turns make it gray.
    Image turns(48, 96, 3);
    for (int y = 0; y < 96; ++y)
        for (int x = 0; x < 48; ++x)
            turns.set_rgb(x, y, (x + y) % 2 ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 1));
    EXPECT_NEAR(exposure_of(turns, {}), 2.0f, 1e-5);
}

// Noise of single pixels, as strong as the signal, must not darken the picture.
TEST(Image, ExposureDoesNotFollowNoise) {
    Image noisy(512, 384, 3);
    unsigned state = 1;
    for (int y = 0; y < noisy.height; ++y)
        for (int x = 0; x < noisy.width; ++x) {
            state = state * 1664525u + 1013904223u;
            noisy.set_rgb(x, y, glm::vec3((state >> 31) != 0 ? 4.0f : 0.0f)); // mean 2
        }
    EXPECT_NEAR(exposure_of(noisy, {}) * 2.0f, 1.0f, 0.25f);
}

TEST(Image, ExposureOfDarkImages) {
    Image black(64, 64, 3);
    EXPECT_EQ(exposure_of(black, {}), 1.0f);
    black.set_rgb(3, 3, glm::vec3(4.0f));
    EXPECT_NEAR(exposure_of(black, {}), 0.25f, 1e-6);
    black.set_rgb(4, 4, glm::vec3(std::numeric_limits<float>::infinity()));
    EXPECT_NEAR(exposure_of(black, {}), 0.25f, 1e-6);
    EXPECT_EQ(exposure_of(black, Image(64, 64, 1)), 1.0f);
}
