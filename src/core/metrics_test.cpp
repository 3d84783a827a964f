// SPDX-License-Identifier: MIT
// Every metric against a value known in closed form.
#include "core/metrics.h"

#include <cmath>

#include <gtest/gtest.h>

using namespace luxel;

namespace {

Image constant(glm::vec3 color, int width = 16, int height = 12) {
    Image image(width, height, 3);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) image.set_rgb(x, y, color);
    return image;
}

// 1 left of `edge`, 0 elsewhere.
Image left_of(int edge, int width = 16, int height = 12) {
    Image mask(width, height, 1);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < edge; ++x) *mask.at(x, y) = 1.0f;
    return mask;
}

Image checkerboard(float dark, float light, int side) {
    Image image(side, side, 3);
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) image.set_rgb(x, y, glm::vec3((x + y) % 2 ? light : dark));
    return image;
}

} // namespace

TEST(Metrics, ConstantOffsets) {
    const Image reference = constant({0.5f, 0.5f, 0.5f}), image = constant({0.6f, 0.5f, 0.2f});
    EXPECT_NEAR(mean_error(reference, image, {}), 0.4 / 3, 1e-7);
    EXPECT_NEAR(rmse(reference, image, {}), std::sqrt(0.1 / 3), 1e-7);
    EXPECT_NEAR(relmse(reference, image, {}), 0.1 / 3 / 0.26, 1e-7);
    EXPECT_NEAR(psnr(reference, image, {}), -10 * std::log10(0.1 / 3), 1e-5);
    EXPECT_EQ(mean_error(reference, reference, {}), 0.0);
    EXPECT_TRUE(std::isinf(psnr(reference, reference, {})));
}

TEST(Metrics, MaskedPixelsAreLeftOut) {
    const Image reference = constant(glm::vec3(0.5f));
    Image image = constant(glm::vec3(0.5f));
    for (int y = 0; y < 12; ++y)
        for (int x = 0; x < 4; ++x) image.set_rgb(x, y, glm::vec3(0.9f));
    EXPECT_NEAR(mean_error(reference, image, {}), 0.4 / 4, 1e-7);
    EXPECT_NEAR(mean_error(reference, image, left_of(8)), 0.4 / 2, 1e-7);
    EXPECT_NEAR(rmse(reference, image, left_of(4)), 0.4, 1e-7);
    EXPECT_EQ(mean_error(reference, image, left_of(0)), 0.0); // nothing counts
    Image outside = left_of(16);
    for (int y = 0; y < 12; ++y)
        for (int x = 0; x < 4; ++x) *outside.at(x, y) = 0.0f;
    EXPECT_EQ(relmse(reference, image, outside), 0.0);
}

TEST(Metrics, CorrelationIsPearsonsOnTheThesisLuminance) {
    Image a(32, 32, 3), scaled(32, 32, 3), inverted(32, 32, 3), recolored(32, 32, 3);
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 32; ++x) {
            const float value = float((x * 7 + y * 13) % 32) / 64.0f;
            a.set_rgb(x, y, glm::vec3(value));
            scaled.set_rgb(x, y, glm::vec3(0.2f + 0.5f * value));
            inverted.set_rgb(x, y, glm::vec3(1.0f - value));
            recolored.set_rgb(x, y, {value / 0.27f, 0.0f, 0.0f});
        }
    EXPECT_NEAR(correlation(a, scaled, {}), 1.0, 1e-6);
    EXPECT_NEAR(correlation(a, inverted, {}), -1.0, 1e-6);
    EXPECT_NEAR(correlation(a, recolored, {}), 1.0, 1e-6);
    EXPECT_EQ(correlation(a, constant(glm::vec3(0.5f), 32, 32), {}), 0.0);

    // Two values against two values: (1, 0, 0, 0) and (1, 1, 0, 0) correlate by 1 / sqrt(3).
    Image one(4, 1, 3), two(4, 1, 3);
    one.set_rgb(0, 0, glm::vec3(1.0f));
    two.set_rgb(0, 0, glm::vec3(1.0f)), two.set_rgb(1, 0, glm::vec3(1.0f));
    EXPECT_NEAR(correlation(one, two, {}), 1.0 / std::sqrt(3.0), 1e-6);
}

TEST(Metrics, SsimClosedForms) {
    // Flat pictures: the luminance term alone.
    const Image dark = constant(glm::vec3(0.25f), 32, 32), light = constant(glm::vec3(0.75f), 32, 32);
    EXPECT_NEAR(ssim(dark, light, {}), (2 * 0.25 * 0.75 + 1e-4) / (0.0625 + 0.5625 + 1e-4), 1e-5);
    EXPECT_NEAR(ssim(dark, dark, {}), 1.0, 1e-6);

    // Checkerboards have mean 1/2 and variance (contrast / 2)^2 in every window: the contrast term alone.
    const Image strong = checkerboard(0, 1, 32), inverse = checkerboard(1, 0, 32),
                weak = checkerboard(0.25f, 0.75f, 32);
    EXPECT_NEAR(ssim(strong, inverse, {}), (-2 * 0.25 + 9e-4) / (2 * 0.25 + 9e-4), 1e-4);
    EXPECT_NEAR(ssim(strong, weak, {}), (2 * 0.125 + 9e-4) / (0.25 + 0.0625 + 9e-4), 1e-4);
    EXPECT_TRUE(std::isnan(ssim(constant(glm::vec3(0), 10, 32), constant(glm::vec3(0), 10, 32), {})));
}

// Whatever lies outside of the mask has no say, at its rim neither.
TEST(Metrics, SsimDoesNotSeeWhatIsMaskedOut) {
    const Image reference = checkerboard(0.25f, 0.75f, 48), weak = checkerboard(0.4f, 0.6f, 48);
    Image image = weak, other = weak;
    for (int y = 0; y < 48; ++y)
        for (int x = 30; x < 48; ++x)
            image.set_rgb(x, y, glm::vec3(float(x % 3))), other.set_rgb(x, y, reference.rgb(x, y));
    const Image mask = left_of(30, 48, 48);
    EXPECT_LT(ssim(reference, image, {}), 0.9 * ssim(reference, weak, {}));
    EXPECT_EQ(ssim(reference, image, mask), ssim(reference, other, mask));
    // A board's window at the mask's rim holds both colors in nearly equal parts, so that its term is the
    // board's.
    EXPECT_NEAR(ssim(reference, image, mask), ssim(reference, weak, {}), 2e-3);

    const Image gray = constant(glm::vec3(0.5f), 48, 32);
    Image corner = gray;
    for (int y = 0; y < 32; ++y)
        for (int x = 40; x < 48; ++x) corner.set_rgb(x, y, glm::vec3(0.0f));
    EXPECT_LT(ssim(gray, corner, {}), 0.99);
    EXPECT_LT(ssim(gray, corner, left_of(41, 48, 32)), 0.9999);
    EXPECT_NEAR(ssim(gray, corner, left_of(40, 48, 32)), 1.0, 1e-6);
}

TEST(Metrics, QualityAndGain) {
    EXPECT_EQ(quality(0.1, 0.2), 1);
    EXPECT_EQ(quality(0.2, 0.1), -1);
    EXPECT_EQ(quality(0.1, 0.1), 0);
    EXPECT_DOUBLE_EQ(gain(0.2, 0.15), 25.0);
    EXPECT_DOUBLE_EQ(gain(0.2, 0.3), -50.0);
    EXPECT_EQ(gain(0.0, 0.0), 0.0);
}

TEST(Metrics, ImprovementCountsStrictlyCloserPixelsAndTies) {
    const Image reference = constant(glm::vec3(0.5f), 4, 1), baseline = constant(glm::vec3(0.4f), 4, 1);
    Image image = baseline;
    image.set_rgb(0, 0, glm::vec3(0.45f)); // closer
    image.set_rgb(1, 0, glm::vec3(0.55f)); // closer, from above
    image.set_rgb(2, 0, glm::vec3(0.7f));  // farther
    const Improvement all = improvement(reference, baseline, image, {});
    EXPECT_DOUBLE_EQ(all.improved, 0.5);
    EXPECT_DOUBLE_EQ(all.tied, 0.25);
    const Improvement some = improvement(reference, baseline, image, left_of(3, 4, 1));
    EXPECT_DOUBLE_EQ(some.improved, 2.0 / 3.0);
    EXPECT_EQ(some.tied, 0.0);
}

TEST(Metrics, DifferencePictureIsWhiteWhereEqual) {
    const Image picture = difference_picture(constant({0.5f, 0.2f, 1.0f}), constant({0.5f, 0.4f, 0.0f}));
    EXPECT_EQ(picture.rgb(3, 3).r, 1.0f);
    EXPECT_NEAR(picture.rgb(3, 3).g, 0.8f, 1e-6);
    EXPECT_EQ(picture.rgb(3, 3).b, 0.0f);
}
