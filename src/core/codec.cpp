// SPDX-License-Identifier: MIT
// What all codecs share: the format by its first bytes, and the limits on what an image may take.
#include "core/codec.h"

#include <algorithm>
#include <string_view>

#include "core/error.h"

namespace luxel::codec {

Format format_of(std::span<const std::uint8_t> bytes) {
    const auto starts = [&](std::string_view magic) {
        return bytes.size() >= magic.size() &&
               std::equal(magic.begin(), magic.end(), bytes.begin(),
                          [](char a, std::uint8_t b) { return std::uint8_t(a) == b; });
    };
    if (starts("\x76\x2f\x31\x01")) return Format::exr;
    if (starts("\x89PNG\r\n\x1a\n")) return Format::png;
    if (starts("\xff\xd8")) return Format::jpeg;
    if (starts("#?")) return Format::radiance;
    if (starts("RIFF") && bytes.size() >= 12 && std::equal(bytes.begin() + 8, bytes.begin() + 12, "WEBP"))
        return Format::webp;
    return Format::unknown;
}

void check_size(std::uint64_t width, std::uint64_t height, std::uint64_t bytes_per_pixel) {
    if (width < 1 || height < 1 || width > max_image_side || height > max_image_side)
        fail(Fault::bad_input, "{}x{} pixels; 1 to {} a side are supported", width, height, max_image_side);
    if (width * height * bytes_per_pixel > max_decoded_bytes)
        fail(Fault::bad_input, "{}x{} pixels of {} bytes are more than {} bytes", width, height,
             bytes_per_pixel, max_decoded_bytes);
}

} // namespace luxel::codec
