// SPDX-License-Identifier: MIT
// JPEG images in memory to 8-bit RGBA; what libjpeg only warns about is an error here.
#include <csetjmp>
#include <cstdio>
#include <string>

#include <jpeglib.h>

#include "core/codec.h"
#include "core/error.h"

namespace luxel::codec {
namespace {

struct Errors {
    jpeg_error_mgr base; // first: libjpeg hands back a pointer to it
    std::jmp_buf escape;
    char message[JMSG_LENGTH_MAX];
};

[[noreturn]] void on_error(j_common_ptr jpeg) {
    auto* errors = reinterpret_cast<Errors*>(jpeg->err);
    jpeg->err->format_message(jpeg, errors->message);
    std::longjmp(errors->escape, 1);
}

void on_message(j_common_ptr jpeg, int level) {
    if (level < 0) on_error(jpeg);
}

// libjpeg leaves by longjmp: nothing with a destructor may live in this frame.
bool read(jpeg_decompress_struct& jpeg, Errors& errors, std::span<const std::uint8_t> bytes, Pixels8& pixels,
          bool& too_large) {
    if (setjmp(errors.escape)) return false;
    jpeg_mem_src(&jpeg, bytes.data(), static_cast<unsigned long>(bytes.size()));
    jpeg_read_header(&jpeg, TRUE);
    jpeg.out_color_space = JCS_EXT_RGBA;
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
    }
    jpeg_finish_decompress(&jpeg);
    return true;
}

} // namespace

Pixels8 decode_jpeg(std::span<const std::uint8_t> bytes) {
    Errors errors{};
    jpeg_decompress_struct jpeg{};
    jpeg.err = jpeg_std_error(&errors.base);
    errors.base.error_exit = on_error;
    errors.base.emit_message = on_message;
    Pixels8 pixels;
    bool too_large = false;
    jpeg_create_decompress(&jpeg);
    const bool complete = read(jpeg, errors, bytes, pixels, too_large);
    const auto width = jpeg.image_width, height = jpeg.image_height;
    jpeg_destroy_decompress(&jpeg);
    if (too_large) fail(Fault::bad_input, "JPEG: {}x{} pixels are too many", width, height);
    if (!complete) fail(Fault::bad_input, "JPEG: {}", errors.message);
    return pixels;
}

} // namespace luxel::codec
