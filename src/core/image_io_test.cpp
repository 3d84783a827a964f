// SPDX-License-Identifier: MIT
// Image files: what is written is read again, what is damaged is refused.
#include "core/image_io.h"

#include <chrono>
#include <cmath>

#include <gtest/gtest.h>

#include "core/error.h"
#include "core/file.h"
#include "support/data.h"

using namespace luxel;

namespace {

std::filesystem::path scratch(const std::string& name) {
    return std::filesystem::path(::testing::TempDir()) / name;
}

Image gradient(int width, int height, int channels) {
    Image image(width, height, channels);
    for (std::size_t i = 0; i < image.data.size(); ++i) image.data[i] = std::sin(float(i) * 0.37f) * 1000.0f;
    return image;
}

} // namespace

TEST(ImageIo, ExrKeepsLayersAndMetadataExactly) {
    const Layers layers = {
        {"", gradient(37, 21, 3)}, {"direct", gradient(37, 21, 4)}, {"depth", gradient(37, 21, 1)}};
    const auto file = scratch("luxel_layers.exr");
    write_exr(file, layers, {{"luxel.samples", "64"}, {"seed", "7"}});
    const ExrFile read = read_exr(file);
    ASSERT_EQ(read.layers.size(), layers.size());
    for (const auto& [name, image] : layers) {
        ASSERT_TRUE(read.layers.contains(name)) << name;
        EXPECT_EQ(read.layers.at(name).channels, image.channels) << name;
        EXPECT_EQ(read.layers.at(name).data, image.data) << name;
    }
    EXPECT_EQ(read.metadata.at("luxel.samples"), "64");
    EXPECT_EQ(read.metadata.at("seed"), "7");
    EXPECT_EQ(read_image(file).data, layers.at("").data);
    std::filesystem::remove(file);
}

TEST(ImageIo, PngRoundsToTheNearestOf256) {
    Image image(256, 2, 4);
    for (int x = 0; x < 256; ++x)
        for (int c = 0; c < 4; ++c) image.at(x, 0)[c] = (float(x) + (c - 1.5f) * 0.3f) / 255.0f;
    const Pixels pixels = decode_pixels(encode_png(image), "memory");
    ASSERT_EQ(pixels.width, 256);
    EXPECT_TRUE(pixels.has_alpha);
    for (std::size_t x = 0; x < 256; ++x)
        for (std::size_t c = 0; c < 4; ++c) EXPECT_EQ(pixels.rgba[4 * x + c], x);
}

TEST(ImageIo, PngBecomesLinear) {
    Image image(2, 1, 3);
    image.set_rgb(0, 0, {0.2f, 0.4f, 1.0f});
    const auto file = scratch("luxel_linear.png");
    write_png(file, image);
    const Image read = read_image(file);
    EXPECT_NEAR(read.rgb(0, 0).r, srgb_decode(51.0f / 255.0f), 1e-6);
    EXPECT_NEAR(read.rgb(0, 0).g, srgb_decode(102.0f / 255.0f), 1e-6);
    EXPECT_NEAR(read.rgb(0, 0).b, 1.0f, 1e-6);
    std::filesystem::remove(file);
}

TEST(ImageIo, FailedWriteLeavesNothing) {
    const auto folder = scratch("luxel_absent_folder");
    EXPECT_THROW(write_exr(folder / "a.exr", {{"", gradient(2, 2, 3)}}), Error);
    EXPECT_THROW(write_png(folder / "a.png", Image(2, 2, 3)), Error);
    EXPECT_FALSE(std::filesystem::exists(folder));
}

TEST(ImageIo, ReadsTheCornellBox) {
    LUXEL_DATA_OR_SKIP(file, "cornell_box/TungstenRender.exr");
    const Image image = read_image(file);
    EXPECT_EQ(image.width, 1024);
    EXPECT_EQ(image.height, 1024);
    EXPECT_GT(luminance(image.rgb(512, 900)), 0.0f);
}
