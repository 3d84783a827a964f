// SPDX-License-Identifier: MIT
// One picture in the three codings of Radiance files, and damage to them.
#include <random>
#include <string>

#include <gtest/gtest.h>

#include "core/codec.h"
#include "core/error.h"
#include "core/file.h"
#include "support/data.h"

using namespace luxel;

namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes picture(const std::string& resolution, const Bytes& pixels,
              const std::string& header = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n") {
    const std::string text = header + resolution + "\n";
    Bytes bytes(text.begin(), text.end());
    bytes.insert(bytes.end(), pixels.begin(), pixels.end());
    return bytes;
}

// 8x1: six pixels of (1, 2, 3) (with exponent 129), then two of (40, 50, 60).
const Bytes flat = {1, 2, 3, 129, 1, 2, 3, 129, 1,  2,  3,  129, 1,  2,  3,  129,
                    1, 2, 3, 129, 1, 2, 3, 129, 40, 50, 60, 129, 40, 50, 60, 129};
const Bytes old_runs = {1, 2, 3, 129, 1, 1, 1, 5, 40, 50, 60, 129, 1, 1, 1, 1};
const Bytes new_runs = {2, 2, 0, 8, 134, 1, 2, 40, 40, 134, 2, 130, 50, 134, 3, 2, 60, 60, 136, 129};

bool refused(const Bytes& bytes) {
    try {
        const Image image = codec::decode_radiance(bytes);
        EXPECT_EQ(image.data.size(), image.pixels() * 3);
        return false;
    } catch (const Error& error) {
        EXPECT_EQ(error.fault(), Fault::bad_input);
        return true;
    }
}

} // namespace

TEST(Radiance, TheThreeCodingsAgree) {
    const Image image = codec::decode_radiance(picture("-Y 1 +X 8", flat));
    ASSERT_EQ(image.width, 8);
    ASSERT_EQ(image.height, 1);
    EXPECT_FLOAT_EQ(image.rgb(0, 0).g, 2.5f / 128.0f); // (mantissa + 1/2) 2^(129 - 136)
    EXPECT_FLOAT_EQ(image.rgb(7, 0).b, 60.5f / 128.0f);
    EXPECT_EQ(codec::decode_radiance(picture("-Y 1 +X 8", old_runs)).data, image.data);
    EXPECT_EQ(codec::decode_radiance(picture("-Y 1 +X 8", new_runs)).data, image.data);
}

TEST(Radiance, LongOldRunsCountInHigherBytes) {
    // 1 + 44 + 2 * 256 = 557 pixels.
    const Image image =
        codec::decode_radiance(picture("-Y 1 +X 557", {9, 9, 9, 128, 1, 1, 1, 44, 1, 1, 1, 2}));
    EXPECT_EQ(image.rgb(556, 0), image.rgb(0, 0));
}

TEST(Radiance, ZeroExponentIsBlack) {
    const Image image = codec::decode_radiance(picture("-Y 1 +X 1", {200, 200, 200, 0}));
    EXPECT_EQ(image.rgb(0, 0), glm::vec3(0.0f));
}

TEST(Radiance, BadHeadersAreRefused) {
    for (const char* resolution : {"+Y 1 +X 8", "-Y 1 -X 8", "+X 8 -Y 1", "-Y 0 +X 8", "-Y -1 +X 8",
                                   "-Y 1 +X 8 ", "-Y 99999 +X 8", "-Y 1", "", "-Y 99999999999 +X 8"})
        EXPECT_TRUE(refused(picture(resolution, flat))) << resolution;
    EXPECT_TRUE(refused(picture("-Y 1 +X 8", flat, "#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n")));
    EXPECT_TRUE(refused(picture("-Y 1 +X 8", flat, "#?RADIANCE\n" + std::string(5000, 'x') + "\n\n")));
    EXPECT_TRUE(refused(Bytes(1 << 20, '\n')));
    EXPECT_TRUE(refused(picture("-Y 1 +X 8", flat, "#?" + std::string(1 << 16, '\n').replace(0, 1, "\nA"))));
    EXPECT_TRUE(refused(picture("-Y 16384 +X 16384", flat)));
}

TEST(Radiance, RunsMustFitTheirRow) {
    EXPECT_TRUE(refused(picture("-Y 1 +X 8", {1, 1, 1, 5})));               // nothing to repeat
    EXPECT_TRUE(refused(picture("-Y 1 +X 8", {1, 2, 3, 129, 1, 1, 1, 8}))); // one too many
    EXPECT_TRUE(refused(picture("-Y 1 +X 8", {2, 2, 0, 9, 136, 1, 136, 1, 136, 1, 136, 1}))); // another width
    EXPECT_TRUE(refused(picture("-Y 1 +X 8", {2, 2, 0, 8, 137, 1, 136, 1, 136, 1, 136, 1}))); // run of nine
    EXPECT_TRUE(refused(picture("-Y 1 +X 8", {2, 2, 0, 8, 0, 1, 136, 1, 136, 1, 136, 1})));   // run of none
    Bytes zero_runs = {1, 2, 3, 129};
    for (int i = 0; i < 1000; ++i) zero_runs.insert(zero_runs.end(), {1, 1, 1, 0});
    EXPECT_TRUE(refused(picture("-Y 1 +X 8", zero_runs)));
}

TEST(Radiance, DamageNeverCrashes) {
    std::mt19937 random(1);
    for (const Bytes& pixels : {flat, old_runs, new_runs}) {
        const Bytes whole = picture("-Y 1 +X 8", pixels);
        for (std::size_t length = 0; length < whole.size(); ++length)
            EXPECT_TRUE(refused(Bytes(whole.begin(), whole.begin() + std::ptrdiff_t(length)))) << length;
        for (int i = 0; i < 3000; ++i) {
            Bytes bytes = whole;
            for (unsigned changes = 1 + random() % 4; changes > 0; --changes)
                bytes[random() % bytes.size()] = std::uint8_t(random());
            refused(bytes);
        }
    }
}

TEST(Radiance, ReadsAnEnvironment) {
    LUXEL_DATA_OR_SKIP(file, "hdri/venice_sunset_1k.hdr");
    const Image image = codec::decode_radiance(read_file(file));
    EXPECT_EQ(image.width, 2 * image.height);
    for (const float value : image.data) ASSERT_TRUE(value >= 0.0f && value < 1e6f);
}
