// SPDX-License-Identifier: MIT
// JPEG as cameras, print shops and careless programs write it; PNG of 16 bits; WebP.
#include <cstdio>
#include <cstdlib>

#include <gtest/gtest.h>
#include <jpeglib.h>
#include <png.h>
#include <webp/encode.h>

#include "core/error.h"
#include "core/image_io.h"

using namespace luxel;

namespace {

using Bytes = std::vector<std::uint8_t>;

// A picture of one color per half, the left (first) half brighter in each component.
struct Jpeg {
    J_COLOR_SPACE given = JCS_RGB, stored = JCS_YCbCr;
    int components = 3;
    bool progressive = false, adobe = true;
    std::uint8_t left[4] = {200, 60, 60, 0}, right[4] = {40, 40, 90, 0};

    Bytes encode() const {
        jpeg_compress_struct jpeg{};
        jpeg_error_mgr errors{};
        jpeg.err = jpeg_std_error(&errors);
        jpeg_create_compress(&jpeg);
        unsigned char* buffer = nullptr;
        unsigned long size = 0;
        jpeg_mem_dest(&jpeg, &buffer, &size);
        jpeg.image_width = 64, jpeg.image_height = 48;
        jpeg.input_components = components, jpeg.in_color_space = given;
        jpeg_set_defaults(&jpeg);
        jpeg_set_colorspace(&jpeg, stored);
        if (!adobe) jpeg.write_Adobe_marker = FALSE;
        jpeg_set_quality(&jpeg, 98, TRUE);
        if (progressive) jpeg_simple_progression(&jpeg);
        jpeg_start_compress(&jpeg, TRUE);
        Bytes row;
        for (int x = 0; x < 64; ++x)
            row.insert(row.end(), x < 32 ? left : right, (x < 32 ? left : right) + components);
        JSAMPROW rows = row.data();
        while (jpeg.next_scanline < jpeg.image_height) jpeg_write_scanlines(&jpeg, &rows, 1);
        jpeg_finish_compress(&jpeg);
        Bytes bytes(buffer, buffer + size);
        jpeg_destroy_compress(&jpeg);
        std::free(buffer);
        return bytes;
    }
};

void expect_colors(const Pixels& pixels, glm::ivec3 left, glm::ivec3 right) {
    ASSERT_EQ(pixels.width, 64);
    for (int x : {0, 20, 44, 63})
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(pixels.rgba[std::size_t((30 * 64 + x) * 4 + c)], (x < 32 ? left : right)[c], 3) << x;
}

std::string refusal(const Bytes& bytes) {
    try {
        decode_pixels(bytes, "file");
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

} // namespace

TEST(CodecJpeg, WithoutItsEndMarker) {
    for (const bool progressive : {false, true}) {
        Bytes bytes = Jpeg{.progressive = progressive}.encode();
        EXPECT_EQ(decode_pixels(bytes, "file").remark, "");
        bytes.resize(bytes.size() - 2);
        const Pixels pixels = decode_pixels(bytes, "file");
        expect_colors(pixels, {200, 60, 60}, {40, 40, 90});
        EXPECT_NE(pixels.remark.find("Premature end"), std::string::npos) << pixels.remark;
    }
}

TEST(CodecJpeg, StrayBytesBeforeAMarker) {
    Bytes bytes = Jpeg{}.encode();
    bytes.insert(bytes.end() - 2, {0, 1, 2, 3, 4});
    const Pixels pixels = decode_pixels(bytes, "file");
    expect_colors(pixels, {200, 60, 60}, {40, 40, 90});
    EXPECT_NE(pixels.remark.find("extraneous bytes"), std::string::npos) << pixels.remark;
    bytes = Jpeg{}.encode();
    bytes.insert(bytes.begin() + 2, {7, 7, 7});
    expect_colors(decode_pixels(bytes, "file"), {200, 60, 60}, {40, 40, 90});
}

// Cut anywhere else pixels are missing: in a scan, or between the scans of a progressive file.
TEST(CodecJpeg, WhatBreaksOffIsRefused) {
    for (const bool progressive : {false, true}) {
        const Bytes bytes = Jpeg{.progressive = progressive}.encode();
        for (std::size_t size = bytes.size() / 2; size + 40 < bytes.size(); size += 17)
            EXPECT_NE(refusal({bytes.begin(), bytes.begin() + std::ptrdiff_t(size)}), "") << size;
        for (std::size_t i = bytes.size() / 3; progressive && i + 2 < bytes.size(); ++i) {
            const bool scan_begins = bytes[i] == 0xff && bytes[i + 1] == 0xda;
            if (!scan_begins) continue;
            EXPECT_NE(refusal({bytes.begin(), bytes.begin() + std::ptrdiff_t(i)}), "") << i;
        }
    }
}

// Inks of (20 %, 90 %, 90 %, 10 %): what is not covered by ink is seen.
TEST(CodecJpeg, InksOfFourKinds) {
    const glm::ivec3 left = {184, 23, 23}, right = {230, 230, 230};
    for (const J_COLOR_SPACE stored : {JCS_CMYK, JCS_YCCK}) {
        // As Adobe's programs write it: 255 minus the ink.
        const Jpeg inverted{.given = JCS_CMYK,
                            .stored = stored,
                            .components = 4,
                            .left = {204, 26, 26, 230},
                            .right = {255, 255, 255, 230}};
        expect_colors(decode_pixels(inverted.encode(), "file"), left, right);
    }
    const Jpeg plain{.given = JCS_CMYK,
                     .stored = JCS_CMYK,
                     .components = 4,
                     .adobe = false,
                     .left = {51, 229, 229, 25},
                     .right = {0, 0, 0, 25}};
    expect_colors(decode_pixels(plain.encode(), "file"), left, right);
}

TEST(CodecJpeg, GrayAndTwelveBits) {
    Jpeg gray{.given = JCS_GRAYSCALE, .stored = JCS_GRAYSCALE, .components = 1};
    expect_colors(decode_pixels(gray.encode(), "file"), glm::ivec3(200), glm::ivec3(40));
    Bytes bytes = gray.encode();
    for (std::size_t i = 0; i + 4 < bytes.size(); ++i)
        if (bytes[i] == 0xff && bytes[i + 1] == 0xc0) bytes[i + 4] = 12; // SOF0: precision
    EXPECT_NE(refusal(bytes).find("12 bits"), std::string::npos) << refusal(bytes);
}

// Every code of 16 bits, in gray and in RGBA.
TEST(CodecPng, SixteenBitsAreKept) {
    for (const bool gray : {true, false}) {
        const int width = 256, height = 256;
        Bytes bytes;
        png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
        png_infop info = png_create_info_struct(png);
        png_set_write_fn(
            png, &bytes,
            [](png_structp p, png_bytep data, std::size_t count) {
                auto& out = *static_cast<Bytes*>(png_get_io_ptr(p));
                out.insert(out.end(), data, data + count);
            },
            nullptr);
        png_set_IHDR(png, info, width, height, 16, gray ? PNG_COLOR_TYPE_GRAY : PNG_COLOR_TYPE_RGBA,
                     PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
        png_write_info(png, info);
        for (int y = 0; y < height; ++y) {
            Bytes row;
            for (int x = 0; x < width; ++x)
                for (int c = 0; c < (gray ? 1 : 4); ++c) {
                    const int code = (y * width + x) ^ (c * 0x1111);
                    row.push_back(std::uint8_t(code >> 8)), row.push_back(std::uint8_t(code));
                }
            png_write_row(png, row.data());
        }
        png_write_end(png, nullptr);
        png_destroy_write_struct(&png, &info);

        const Pixels pixels = decode_pixels(bytes, "file");
        ASSERT_TRUE(pixels.is_wide());
        EXPECT_TRUE(pixels.rgba.empty());
        EXPECT_EQ(pixels.has_alpha, !gray);
        for (int i = 0; i < width * height; ++i)
            for (int c = 0; c < 4; ++c)
                ASSERT_EQ(pixels.wide[std::size_t(4 * i + c)],
                          gray ? (c < 3 ? i : 0xffff) : (i ^ (c * 0x1111)));
        // As linear light: a code in between two of 8 bits is not rounded to one of them.
        const Image light = decode_image(bytes, "file");
        EXPECT_NEAR(light.rgb(0x80, 0x80).r, srgb_decode(float(0x8080) / 65535.0f), 1e-7f);
        EXPECT_NEAR(light.rgb(0xff, 0x7f).r, srgb_decode(float(0x7fff) / 65535.0f), 1e-7f);
    }
}

TEST(CodecWebp, ColorsAndAlpha) {
    Bytes rgba;
    for (int i = 0; i < 12 * 5; ++i)
        for (int c = 0; c < 4; ++c) rgba.push_back(std::uint8_t(i * 4 + c * 50));
    std::uint8_t* encoded = nullptr;
    const std::size_t size = WebPEncodeLosslessRGBA(rgba.data(), 12, 5, 12 * 4, &encoded);
    ASSERT_GT(size, 0u);
    const Bytes bytes(encoded, encoded + size);
    WebPFree(encoded);
    const Pixels pixels = decode_pixels(bytes, "file");
    ASSERT_EQ(pixels.width, 12);
    ASSERT_EQ(pixels.height, 5);
    EXPECT_TRUE(pixels.has_alpha);
    for (std::size_t i = 0; i < rgba.size(); ++i) {
        const bool hidden = rgba[i / 4 * 4 + 3] == 0; // lossless coding may drop colors that are not seen
        EXPECT_TRUE(hidden || pixels.rgba[i] == rgba[i]) << i;
    }
    for (std::size_t cut = 0; cut + 1 < size; cut += 7)
        EXPECT_NE(refusal({bytes.begin(), bytes.begin() + std::ptrdiff_t(cut)}), "") << cut;
    const Bytes ktx2 = {0xab, 'K', 'T', 'X', ' ', '2', '0', 0xbb, '\r', '\n', 0x1a, '\n'};
    EXPECT_NE(refusal(ktx2).find("KTX2 is not read; convert it to PNG"), std::string::npos) << refusal(ktx2);
}
