// SPDX-License-Identifier: MIT
// The decoders of untrusted image bytes. They run in the decoding process only (decode_process.h).
// Errors carry the reason alone; the caller puts the file's name before it.
#pragma once
#include <cstdint>
#include <span>

#include "core/image_io.h"

namespace luxel::codec {

// What one file may decode to, in bytes; checked against the header before anything is allocated.
inline constexpr std::uint64_t max_decoded_bytes = std::uint64_t(1) << 30;

enum class Format { exr, radiance, png, jpeg, webp, unknown };
// What the first bytes say.
Format format_of(std::span<const std::uint8_t> bytes);

ExrFile decode_exr(std::span<const std::uint8_t> bytes);
Pixels decode_png(std::span<const std::uint8_t> bytes);
Pixels decode_jpeg(std::span<const std::uint8_t> bytes);
Pixels decode_webp(std::span<const std::uint8_t> bytes);
Image decode_radiance(std::span<const std::uint8_t> bytes);

// Error Fault::bad_input unless 1 <= side <= max_image_side and all of it fits in max_decoded_bytes.
void check_size(std::uint64_t width, std::uint64_t height, std::uint64_t bytes_per_pixel);

// The header of an EXR file by our own bounds-checked reader: flat, scan lines or one tile level,
// unsubsampled channels, windows within the limits; the same for every part. Error Fault::bad_input
// otherwise.
struct ExrHeader {
    int parts = 1;
};
ExrHeader check_exr_header(std::span<const std::uint8_t> bytes);

} // namespace luxel::codec
