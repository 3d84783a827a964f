// SPDX-License-Identifier: MIT
// PNG images in memory to RGBA of 8 bits or, where the file has them, of 16.
#include <algorithm>
#include <bit>
#include <csetjmp>
#include <cstring>

#include <png.h>

#include "core/codec.h"
#include "core/error.h"

namespace luxel::codec {
namespace {

struct Source {
    std::span<const std::uint8_t> bytes;
    std::string message;
};

void read_bytes(png_structp png, png_bytep target, std::size_t count) {
    auto& source = *static_cast<Source*>(png_get_io_ptr(png));
    if (count > source.bytes.size()) png_error(png, "the file ends early");
    std::memcpy(target, source.bytes.data(), count);
    source.bytes = source.bytes.subspan(count);
}

[[noreturn]] void on_error(png_structp png, png_const_charp message) {
    static_cast<Source*>(png_get_error_ptr(png))->message = message;
    png_longjmp(png, 1);
}

void on_warning(png_structp, png_const_charp) {}

// libpng leaves by longjmp: nothing with a destructor may live in this frame. False: source.message says why.
bool read(png_structp png, png_infop info, Source& source, Pixels& pixels, std::vector<png_bytep>& rows) {
    if (setjmp(png_jmpbuf(png))) return false;
    png_set_read_fn(png, &source, read_bytes);
    png_set_user_limits(png, max_image_side, max_image_side);
    png_set_chunk_cache_max(png, 64);
    png_set_chunk_malloc_max(png, 16 << 20);
    png_read_info(png, info);
    pixels.width = int(png_get_image_width(png, info));
    pixels.height = int(png_get_image_height(png, info));
    if (std::uint64_t(pixels.width) * std::uint64_t(pixels.height) * 8 > max_decoded_bytes)
        png_error(png, "too many pixels");

    // Everything becomes RGBA as stored; 16 bits stand in the file with the high byte first.
    const bool wide = png_get_bit_depth(png, info) == 16;
    png_set_expand(png);
    png_set_gray_to_rgb(png);
    png_set_add_alpha(png, wide ? 0xffff : 0xff, PNG_FILLER_AFTER);
    if (wide && std::endian::native == std::endian::little) png_set_swap(png);
    png_set_interlace_handling(png);
    png_read_update_info(png, info);
    const std::size_t row = std::size_t(pixels.width) * 4, count = row * std::size_t(pixels.height);
    if (png_get_rowbytes(png, info) != row * (wide ? 2 : 1)) png_error(png, "unexpected row size");
    wide ? pixels.wide.resize(count) : pixels.rgba.resize(count);
    rows.resize(std::size_t(pixels.height));
    for (std::size_t y = 0; y < rows.size(); ++y)
        rows[y] =
            wide ? reinterpret_cast<png_bytep>(pixels.wide.data() + y * row) : pixels.rgba.data() + y * row;
    png_read_image(png, rows.data());
    png_read_end(png, nullptr);
    return true;
}

} // namespace

Pixels decode_png(std::span<const std::uint8_t> bytes) {
    Source source{bytes, {}};
    Pixels pixels;
    std::vector<png_bytep> rows;
    png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &source, on_error, on_warning);
    png_infop info = png ? png_create_info_struct(png) : nullptr;
    const bool complete = info && read(png, info, source, pixels, rows);
    png_destroy_read_struct(&png, &info, nullptr);
    if (!complete)
        fail(Fault::bad_input, "PNG: {}", source.message.empty() ? "out of memory" : source.message);

    for (std::size_t i = 3; i < pixels.rgba.size() && !pixels.has_alpha; i += 4)
        pixels.has_alpha = pixels.rgba[i] < 0xff;
    for (std::size_t i = 3; i < pixels.wide.size() && !pixels.has_alpha; i += 4)
        pixels.has_alpha = pixels.wide[i] < 0xffff;
    return pixels;
}

} // namespace luxel::codec
