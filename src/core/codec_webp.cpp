// SPDX-License-Identifier: MIT
// WebP images in memory to 8-bit RGBA.
#include <webp/decode.h>

#include "core/codec.h"
#include "core/error.h"

namespace luxel::codec {

Pixels decode_webp(std::span<const std::uint8_t> bytes) {
    WebPBitstreamFeatures features{};
    if (WebPGetFeatures(bytes.data(), bytes.size(), &features) != VP8_STATUS_OK)
        fail(Fault::bad_input, "WebP: the header is damaged");
    if (features.has_animation) fail(Fault::bad_input, "WebP: animations are not supported");
    check_size(std::uint64_t(features.width), std::uint64_t(features.height), 8);

    Pixels pixels;
    pixels.width = features.width, pixels.height = features.height;
    pixels.rgba.resize(std::size_t(pixels.width) * std::size_t(pixels.height) * 4);
    if (!WebPDecodeRGBAInto(bytes.data(), bytes.size(), pixels.rgba.data(), pixels.rgba.size(),
                            4 * pixels.width))
        fail(Fault::bad_input, "WebP: the image is damaged or cut off");
    for (std::size_t i = 3; i < pixels.rgba.size() && !pixels.has_alpha; i += 4)
        pixels.has_alpha = pixels.rgba[i] < 0xff;
    return pixels;
}

} // namespace luxel::codec
