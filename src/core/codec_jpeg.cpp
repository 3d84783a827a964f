// SPDX-License-Identifier: MIT
// JPEG images in memory to 8-bit RGBA. What libjpeg only warns about is an error where pixels are lost.
#include <csetjmp>
#include <cstdio>
#include <string>

#include <jpeglib.h>

#include <jerror.h> // after jpeglib.h

#include "core/codec.h"
#include "core/error.h"

namespace luxel::codec {
namespace {

struct Errors {
    jpeg_error_mgr base; // first: libjpeg hands back a pointer to it
    std::jmp_buf escape;
    char message[JMSG_LENGTH_MAX]; // of the error, or of the first warning
    bool ended_early;              // no end marker
};

[[noreturn]] void on_error(j_common_ptr jpeg) {
    auto* errors = reinterpret_cast<Errors*>(jpeg->err);
    jpeg->err->format_message(jpeg, errors->message);
    std::longjmp(errors->escape, 1);
}

// Warnings that say that pixels are wrong or missing are errors; those that do not are kept as a remark.
void on_message(j_common_ptr jpeg, int level) {
    if (level >= 0) return;
    auto* errors = reinterpret_cast<Errors*>(jpeg->err);
    switch (jpeg->err->msg_code) {
    case JWRN_JPEG_EOF:
        errors->ended_early = true;
        [[fallthrough]];
    case JWRN_EXTRANEOUS_DATA:
    case JWRN_ADOBE_XFORM:
    case JWRN_JFIF_MAJOR:
        if (errors->message[0] == '\0') jpeg->err->format_message(jpeg, errors->message);
        break;
    default:
        on_error(jpeg);
    }
}

// Files whose end is missing are whole where every component has been seen, in progressive ones each
// coefficient to its last bit. (A scan that breaks off is a warning of its own.)
bool is_whole(const jpeg_decompress_struct& jpeg) {
    for (int c = 0; c < jpeg.num_components; ++c) {
        if (!jpeg.comp_info[c].quant_table) return false;
        for (int i = 0; jpeg.coef_bits && i < DCTSIZE2; ++i)
            if (jpeg.coef_bits[c][i] != 0) return false;
    }
    return true;
}

// Inks to colors: C, M and Y in place of R, G and B. Adobe's programs store 255 minus the ink.
void from_inks(std::uint8_t* row, int width, bool inverted) {
    for (std::uint8_t* p = row; p < row + 4 * width; p += 4) {
        for (int c = 0; c < 4; ++c) p[c] = std::uint8_t(inverted ? p[c] : 255 - p[c]);
        for (int c = 0; c < 3; ++c) p[c] = std::uint8_t((p[c] * p[3] + 127) / 255);
        p[3] = 255;
    }
}

// libjpeg leaves by longjmp: nothing with a destructor may live in this frame.
bool read(jpeg_decompress_struct& jpeg, Errors& errors, std::span<const std::uint8_t> bytes, Pixels& pixels,
          bool& too_large) {
    if (setjmp(errors.escape)) return false;
    jpeg_mem_src(&jpeg, bytes.data(), static_cast<unsigned long>(bytes.size()));
    jpeg_read_header(&jpeg, TRUE);
    const bool inks = jpeg.jpeg_color_space == JCS_CMYK || jpeg.jpeg_color_space == JCS_YCCK;
    jpeg.out_color_space = inks ? JCS_CMYK : JCS_EXT_RGBA;
    too_large = jpeg.image_width > max_image_side || jpeg.image_height > max_image_side ||
                std::uint64_t(jpeg.image_width) * jpeg.image_height * 8 > max_decoded_bytes;
    if (too_large) return false;

    jpeg_start_decompress(&jpeg);
    pixels.width = int(jpeg.output_width);
    pixels.height = int(jpeg.output_height);
    pixels.rgba.resize(std::size_t(pixels.width) * std::size_t(pixels.height) * 4);
    while (jpeg.output_scanline < jpeg.output_height) {
        JSAMPROW row = pixels.rgba.data() + std::size_t(jpeg.output_scanline) * std::size_t(pixels.width) * 4;
        jpeg_read_scanlines(&jpeg, &row, 1);
        if (inks) from_inks(row, pixels.width, jpeg.saw_Adobe_marker);
    }
    const bool whole = is_whole(jpeg);
    jpeg_finish_decompress(&jpeg);
    return whole || !errors.ended_early;
}

} // namespace

Pixels decode_jpeg(std::span<const std::uint8_t> bytes) {
    Errors errors{};
    jpeg_decompress_struct jpeg{};
    jpeg.err = jpeg_std_error(&errors.base);
    errors.base.error_exit = on_error;
    errors.base.emit_message = on_message;
    Pixels pixels;
    bool too_large = false;
    jpeg_create_decompress(&jpeg);
    const bool complete = read(jpeg, errors, bytes, pixels, too_large);
    const auto width = jpeg.image_width, height = jpeg.image_height;
    const int precision = jpeg.data_precision;
    jpeg_destroy_decompress(&jpeg);
    if (too_large) fail(Fault::bad_input, "JPEG: {}x{} pixels are too many", width, height);
    if (!complete && errors.base.msg_code == JERR_BAD_PRECISION)
        fail(Fault::bad_input, "JPEG: {} bits per channel are not supported, only 8; convert it to PNG",
             precision);
    if (!complete) fail(Fault::bad_input, "JPEG: {}", errors.message);
    if (errors.message[0] != '\0')
        pixels.remark = fmt::format("JPEG, decoded to its end: {}", errors.message);
    return pixels;
}

} // namespace luxel::codec
