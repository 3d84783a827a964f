// SPDX-License-Identifier: MIT
#include "techniques/frame/texture_levels.h"

#include <cmath>

#include <gtest/gtest.h>

#include "scene/surface.h"
#include "shared/random.h"
#include "techniques/frame/mask_params.h"

namespace luxel {
namespace {

Texture texture_of(int width, int height, std::uint32_t seed) {
    Texture t;
    t.pixels.width = width, t.pixels.height = height;
    for (int i = 0; i < width * height * 4; ++i)
        t.pixels.rgba.push_back(std::uint8_t(shared::hash2(seed, std::uint32_t(i)) >> 24));
    return t;
}

glm::dvec4 mean_of(const Image& image) {
    glm::dvec4 sum(0.0);
    for (std::size_t i = 0; i < image.data.size(); ++i) sum[int(i % 4)] += double(image.data[i]);
    return sum / double(image.pixels());
}

} // namespace

// Odd sizes, where a blit drops columns: every level has the mean of the first.
TEST(TextureLevels, EveryLevelHasTheMean) {
    Texture t = texture_of(37, 11, 1);
    t.srgb = true;
    const std::vector<Image> levels = texture_levels(t, std::nullopt);
    ASSERT_EQ(levels.size(), 6u);
    EXPECT_EQ(levels[1].width, 18);
    EXPECT_EQ(levels[5].width, 1);
    for (const Image& level : levels)
        for (int c = 0; c < 4; ++c) EXPECT_NEAR(mean_of(level)[c], mean_of(levels[0])[c], 1e-5) << c;
}

// Coverage is what the bilinear filter of the first level leaves, whatever the cutoff.
TEST(TextureLevels, MasksKeepTheirCoverage) {
    const Texture t = texture_of(32, 32, 2);
    for (const float cutoff : {0.2f, 0.5f, 0.9f}) {
        constexpr int fine = 1024;
        int covered = 0;
        for (int y = 0; y < fine; ++y)
            for (int x = 0; x < fine; ++x)
                covered += sample_texture(t, (glm::vec2(x, y) + 0.5f) / float(fine)).a >= cutoff;
        const double expected = double(covered) / (fine * fine);
        const std::vector<Image> levels = texture_levels(t, cutoff);
        EXPECT_FLOAT_EQ(levels[0].at(3, 5)[3], t.pixels.value(4 * (5 * 32 + 3) + 3));
        for (std::size_t i = 1; i < levels.size(); ++i)
            EXPECT_NEAR(mean_of(levels[i]).a, expected, 5e-3) << cutoff << " level " << i;
    }
}

// What holes hide is another color: it must not bleed out of them.
TEST(TextureLevels, HiddenColorsStayHidden) {
    Texture t;
    t.pixels.width = t.pixels.height = 16;
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x) {
            const bool leaf = (x / 4 + y / 4) % 2 == 0;
            for (int c = 0; c < 3; ++c) t.pixels.rgba.push_back(leaf == (c == 1) ? 255 : 0);
            t.pixels.rgba.push_back(leaf ? 255 : 0);
        }
    const std::vector<Image> levels = texture_levels(t, 0.5f);
    for (std::size_t i = 1; i < levels.size(); ++i)
        for (std::size_t k = 0; k < levels[i].data.size(); k += 4) {
            if (levels[i].data[k + 3] < 0.01f) continue;
            EXPECT_NEAR(levels[i].data[k], 0.0f, 1e-5f) << i;
            EXPECT_NEAR(levels[i].data[k + 1], 1.0f, 1e-5f) << i;
        }
}

// Over 48 x 48 pixels the share below a value is that value, more evenly than chance has it; two surfaces
// hide each other's pixels as often as independent ones.
TEST(MaskThresholds, AreEvenAndIndependent) {
    constexpr int side = 48, surfaces = 200;
    for (const float share : {0.1f, 0.25f, 0.6f}) {
        double all = 0.0, levels = 0.0, squares = 0.0;
        for (shared::uint s = 0; s < surfaces; ++s) {
            int here = 0, both = 0;
            for (shared::uint y = 0; y < side; ++y)
                for (shared::uint x = 0; x < side; ++x) {
                    const auto a = shared::mask_thresholds(100 + x, 50 + y, 2 * s),
                               b = shared::mask_thresholds(100 + x, 50 + y, 2 * s + 1);
                    here += a.coverage < share;
                    both += a.coverage < share && b.coverage < share;
                    levels += a.coverage < share && a.level < 0.5f;
                }
            constexpr double pixels = side * side;
            EXPECT_NEAR(both / pixels, share * share, 0.05) << s;
            squares += std::pow(here / pixels - double(share), 2.0) / surfaces;
            all += here / pixels / surfaces;
        }
        EXPECT_NEAR(all, share, 1e-3);
        EXPECT_NEAR(levels / (double(surfaces) * side * side), share * 0.5, 5e-3);
        // A third of the variance of independent pixels.
        EXPECT_LT(squares, double(share * (1.0f - share)) / (side * side) / 3.0);
    }
}

} // namespace luxel
