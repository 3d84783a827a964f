// SPDX-License-Identifier: MIT
// Untrusted images: every file decodes or is refused in one sentence; none crashes or hangs.
#include <chrono>
#include <cstdio>
#include <random>

#include <gtest/gtest.h>
#include <jpeglib.h>

#include "core/codec.h"
#include "core/decode_message.h"
#include "core/decode_process.h"
#include "core/error.h"
#include "core/file.h"
#include "core/image_io.h"
#include "support/data.h"

using namespace luxel;

namespace {

using Bytes = std::vector<std::uint8_t>;

// The reason of the refusal, or "" when the bytes decode to an image of plausible size.
std::string refusal(const Bytes& bytes) {
    const codec::Format format = codec::format_of(bytes);
    try {
        if (format == codec::Format::png || format == codec::Format::jpeg) {
            const Pixels pixels = decode_pixels(bytes, "file");
            EXPECT_EQ(pixels.rgba.size(), std::size_t(pixels.width) * std::size_t(pixels.height) * 4);
            EXPECT_FALSE(pixels.rgba.empty());
        } else {
            const Image image = decode_hdr(bytes, "file");
            EXPECT_FALSE(image.empty());
            EXPECT_EQ(image.data.size(), image.pixels() * std::size_t(image.channels));
        }
    } catch (const Error& error) {
        EXPECT_TRUE(std::string(error.what()).starts_with("file: ")) << error.what();
        EXPECT_EQ(error.fault(), Fault::bad_input) << error.what();
        return error.what();
    }
    return "";
}

Bytes sample_png() {
    Image image(19, 13, 3);
    for (std::size_t i = 0; i < image.data.size(); ++i) image.data[i] = float(i % 37) / 36.0f;
    return encode_png(image);
}

Bytes sample_exr() {
    Image image(19, 13, 3);
    for (std::size_t i = 0; i < image.data.size(); ++i) image.data[i] = float(i % 37);
    const auto file = std::filesystem::path(::testing::TempDir()) / "luxel_decode_sample.exr";
    write_exr(file, {{"", image}});
    Bytes bytes = read_file(file);
    std::filesystem::remove(file);
    return bytes;
}

Bytes sample_jpeg() {
    jpeg_compress_struct jpeg{};
    jpeg_error_mgr errors{};
    jpeg.err = jpeg_std_error(&errors);
    jpeg_create_compress(&jpeg);
    unsigned char* buffer = nullptr;
    unsigned long size = 0;
    jpeg_mem_dest(&jpeg, &buffer, &size);
    jpeg.image_width = 19, jpeg.image_height = 13, jpeg.input_components = 3, jpeg.in_color_space = JCS_RGB;
    jpeg_set_defaults(&jpeg);
    jpeg_start_compress(&jpeg, TRUE);
    Bytes row(19 * 3, 100);
    JSAMPROW rows = row.data();
    while (jpeg.next_scanline < jpeg.image_height) jpeg_write_scanlines(&jpeg, &rows, 1);
    jpeg_finish_compress(&jpeg);
    Bytes bytes(buffer, buffer + size);
    jpeg_destroy_compress(&jpeg);
    std::free(buffer);
    return bytes;
}

// Cut at every 16th of its length, then with one to four random bytes changed.
void expect_survival(const Bytes& whole, int mutations) {
    ASSERT_EQ(refusal(whole), "");
    for (std::size_t part = 0; part < 16; ++part) {
        const Bytes cut(whole.begin(), whole.begin() + std::ptrdiff_t(whole.size() * part / 16));
        EXPECT_NE(refusal(cut), "") << part << "/16 of the file";
    }
    std::mt19937 random(1);
    for (int i = 0; i < mutations; ++i) {
        Bytes bytes = whole;
        for (unsigned changes = 1 + random() % 4; changes > 0; --changes)
            bytes[random() % bytes.size()] = std::uint8_t(random());
        refusal(bytes);
    }
}

} // namespace

TEST(Decode, DamagedPngIsRefused) { expect_survival(sample_png(), 30); }
TEST(Decode, DamagedJpegIsRefused) { expect_survival(sample_jpeg(), 30); }
TEST(Decode, DamagedExrIsRefused) { expect_survival(sample_exr(), 60); }

TEST(Decode, JpegKeepsItsColor) {
    const Pixels pixels = decode_pixels(sample_jpeg(), "file");
    ASSERT_EQ(pixels.width, 19);
    ASSERT_EQ(pixels.height, 13);
    EXPECT_FALSE(pixels.has_alpha);
    for (std::size_t i = 0; i < pixels.rgba.size(); ++i)
        EXPECT_NEAR(pixels.rgba[i], i % 4 == 3 ? 255 : 100, 1);
}

TEST(Decode, WrongKindsAreNamed) {
    EXPECT_EQ(refusal({}), "file: neither OpenEXR nor Radiance");
    EXPECT_THROW(decode_hdr(sample_png(), "file"), Error);
    EXPECT_THROW(decode_pixels(sample_exr(), "file"), Error);
}

// The header promises more than the limits allow: refused before any memory is taken.
TEST(Decode, BombsAreRefusedByTheirHeaders) {
    Bytes exr = sample_exr();
    const std::string window = "dataWindow";
    const auto at = std::search(exr.begin(), exr.end(), window.begin(), window.end());
    ASSERT_NE(at, exr.end());
    const auto x_max = at - exr.begin() + std::ptrdiff_t(window.size() + 1 + sizeof("box2i") + 4 + 8);
    exr[std::size_t(x_max) + 1] = 0x7f; // 0x7f12: 32531 columns
    EXPECT_NE(refusal(exr).find("1 to 16384 a side"), std::string::npos) << refusal(exr);
    Bytes png = sample_png();
    png[16] = 0x7f; // IHDR width; its checksum fails as well
    EXPECT_NE(refusal(png), "");
}

// A bad one among small ones is refused alone, though they share a process; other kinds are named.
TEST(Decode, SeveralAtOnce) {
    const Bytes good = sample_png(), jpeg = sample_jpeg(), exr = sample_exr();
    Bytes bad = good;
    bad[bad.size() / 2] ^= 0xff;
    std::vector<EncodedImage> images;
    const std::vector<const Bytes*> files = {&good, &bad, &jpeg, &exr, &good, &good, &bad, &jpeg};
    for (const Bytes* bytes : files)
        images.push_back({*bytes, "image " + std::to_string(images.size())});
    const auto results = decode_pixels(images);
    ASSERT_EQ(results.size(), images.size());
    for (std::size_t i : {0u, 2u, 4u, 5u, 7u}) {
        ASSERT_TRUE(std::holds_alternative<Pixels>(results[i])) << i;
        EXPECT_EQ(std::get<Pixels>(results[i]).rgba, decode_pixels(images[i].bytes, "file").rgba) << i;
    }
    for (std::size_t i : {1u, 6u})
        EXPECT_TRUE(std::string(std::get<Error>(results[i]).what())
                        .starts_with("image " + std::to_string(i) + ": PNG: "));
    EXPECT_STREQ(std::get<Error>(results[3]).what(), "image 3: not PNG, JPEG or WebP");
}

// Run by the next test from a folder that has no luxel-decode.
TEST(DecodeAlone, NothingIsDecoded) {
    const auto self = std::filesystem::read_symlink("/proc/self/exe");
    if (std::filesystem::exists(self.parent_path() / "luxel-decode")) GTEST_SKIP() << "the process is there";
    Bytes radiance;
    for (char c : std::string("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\nabcd"))
        radiance.push_back(std::uint8_t(c));
    for (const Bytes& bytes : {sample_png(), sample_jpeg(), sample_exr(), radiance}) {
        try {
            decode_image(bytes, "file");
            ADD_FAILURE() << "decoded in this process";
        } catch (const Error& error) {
            EXPECT_EQ(error.fault(), Fault::io);
            EXPECT_NE(std::string(error.what()).find("luxel-decode is missing"), std::string::npos)
                << error.what();
        }
    }
}

TEST(Decode, WithoutItsProcessNothingIsDecoded) {
    const auto folder = std::filesystem::path(::testing::TempDir()) / "luxel_decode_alone";
    std::filesystem::create_directories(folder);
    const auto copy = folder / "test";
    std::filesystem::copy_file("/proc/self/exe", copy, std::filesystem::copy_options::overwrite_existing);
    const std::string log = (folder / "log").string();
    EXPECT_EQ(std::system((copy.string() + " --gtest_filter=DecodeAlone.* > " + log + " 2>&1").c_str()), 0);
    const Bytes said = read_file(log);
    const std::string text(said.begin(), said.end());
    EXPECT_NE(text.find("[  PASSED  ] 1 test"), std::string::npos) << text;
    EXPECT_EQ(text.find("SKIPPED"), std::string::npos) << text;
    std::filesystem::remove_all(folder);
}

// What a decoder that was taken over could answer is bounded on our side.
TEST(Decode, AnswersAreNotTrusted) {
    const auto receive = [](std::vector<std::uint32_t> words) {
        std::span<const std::uint8_t> rest(reinterpret_cast<const std::uint8_t*>(words.data()),
                                           words.size() * 4);
        return codec::receive([rest](void* target, std::size_t count) mutable {
            if (count > rest.size()) fail(Fault::bad_input, "end");
            std::copy_n(rest.begin(), count, static_cast<std::uint8_t*>(target));
            rest = rest.subspan(count);
        });
    };
    EXPECT_THROW(receive({0}), Error);
    EXPECT_THROW(receive({9}), Error);
    EXPECT_THROW(receive({2, 16385, 1, 0}), Error);
    EXPECT_THROW(receive({2, 0, 0, 0}), Error);
    EXPECT_THROW(receive({3, 1, 0, 16384, 16384, 4}), Error);
    EXPECT_THROW(receive({3, 0xffffffff}), Error);
    EXPECT_THROW(receive({3, 1, 0xffffffff}), Error);
    EXPECT_EQ(std::get<Pixels>(receive({2, 1, 1, 0, 0, 0x01020304, 0})).rgba, (Bytes{4, 3, 2, 1}));
    try {
        receive({1, 4, 0x0a1b4141});
        ADD_FAILURE() << "a refusal is an error";
    } catch (const Error& error) {
        EXPECT_STREQ(error.what(), "AA??"); // no control characters reach the terminal
    }
}

TEST(Decode, EveryFileOfTheCorpusDecodesOrIsRefusedQuickly) {
    LUXEL_DATA_OR_SKIP(corpus, "robustness");
    int decoded = 0, refused = 0, stopped = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(corpus)) {
        if (!entry.is_regular_file()) continue;
        const std::string folder = entry.path().lexically_relative(corpus).begin()->string();
        const Bytes bytes = read_file(entry.path());
        const bool image = folder.starts_with("exr") || folder.starts_with("hdr") ||
                           codec::format_of(bytes) != codec::Format::unknown;
        if (!image) continue;

        const auto start = std::chrono::steady_clock::now();
        const std::string reason = refusal(bytes);
        const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
        EXPECT_LT(taken.count(), 5.0) << entry.path();
        (reason.empty() ? decoded : refused)++;
        if (reason.find("stopped") != std::string::npos) {
            ++stopped;
            std::printf("%s: %s\n", entry.path().filename().c_str(), reason.c_str());
        }
        std::printf("%s: %s\n", entry.path().filename().c_str(), reason.c_str());
    }
    std::printf("%d decoded, %d refused, of them %d by ending the decoder\n", decoded, refused, stopped);
    EXPECT_GT(decoded, 0);
    EXPECT_GT(refused, 0);
}
