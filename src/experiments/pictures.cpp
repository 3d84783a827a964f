// SPDX-License-Identifier: MIT
#include "experiments/pictures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include <jpeglib.h>

#include "core/error.h"

namespace luxel {

namespace {

constexpr glm::vec3 outside(0.93f, 0.94f, 0.95f); // pixels that do not count

// Piecewise linear through sRGB anchors, dark = wrong: readable on paper and for the color-blind.
template <std::size_t N> glm::vec3 gradient(const std::array<glm::vec3, N>& anchors, float t) {
    const float x = std::clamp(t, 0.0f, 1.0f) * float(N - 1);
    const std::size_t i = std::min(std::size_t(x), N - 2);
    return glm::mix(anchors[i], anchors[i + 1], x - float(i));
}

const std::array<glm::vec3, 5> error_colors = {glm::vec3(1.0f),
                                               {0.99f, 0.80f, 0.48f},
                                               {0.93f, 0.42f, 0.25f},
                                               {0.60f, 0.11f, 0.25f},
                                               {0.10f, 0.03f, 0.10f}};
const std::array<glm::vec3, 5> change_colors = {glm::vec3(0.60f, 0.05f, 0.08f),
                                                {0.95f, 0.55f, 0.45f},
                                                {1.0f, 1.0f, 1.0f},
                                                {0.48f, 0.70f, 0.95f},
                                                {0.05f, 0.20f, 0.60f}};

float distance(const Image& a, const Image& b, int x, int y) {
    const glm::vec3 d = glm::abs(a.rgb(x, y) - b.rgb(x, y));
    return (d.r + d.g + d.b) / 3.0f;
}

template <class Color> Image map_pixels(const Image& mask, Color color) {
    Image map(mask.width, mask.height, 3);
    for (int y = 0; y < mask.height; ++y)
        for (int x = 0; x < mask.width; ++x) map.set_rgb(x, y, mask.at(x, y)[0] > 0 ? color(x, y) : outside);
    return map;
}

} // namespace

Image error_map(const Image& shown_reference, const Image& shown, const Image& mask) {
    return map_pixels(mask, [&](int x, int y) {
        return gradient(error_colors, distance(shown_reference, shown, x, y) / float(error_scale));
    });
}

Image signed_map(const Image& shown_reference, const Image& shown, const Image& mask) {
    return map_pixels(mask, [&](int x, int y) {
        const glm::vec3 d = shown.rgb(x, y) - shown_reference.rgb(x, y);
        return gradient(change_colors, 0.5f - 0.5f * (d.r + d.g + d.b) / 3.0f / float(signed_scale));
    });
}

Image flip_picture(const Image& flip, const Image& mask) {
    return map_pixels(
        mask, [&](int x, int y) { return gradient(error_colors, flip.at(x, y)[0] / float(flip_scale)); });
}

Image bright_picture(const Image& radiance, float exposure) {
    const bool cut = std::any_of(radiance.data.begin(), radiance.data.end(),
                                 [&](float value) { return value * exposure > 1.0f; });
    return cut ? display(radiance, exposure / float(bright_scale)) : Image();
}

Image change_map(const Image& shown_reference, const Image& shown_baseline, const Image& shown,
                 const Image& mask) {
    return map_pixels(mask, [&](int x, int y) {
        const float closer =
            distance(shown_reference, shown_baseline, x, y) - distance(shown_reference, shown, x, y);
        return gradient(change_colors, 0.5f + 0.5f * closer / float(change_scale));
    });
}

Image shrink(const Image& image, int width) {
    const int n = (image.width + width - 1) / width;
    if (n <= 1) return image;
    Image small(std::max(image.width / n, 1), std::max(image.height / n, 1), 3);
    for (int y = 0; y < small.height; ++y)
        for (int x = 0; x < small.width; ++x) {
            glm::vec3 sum(0.0f);
            int count = 0;
            for (int v = y * n; v < std::min((y + 1) * n, image.height); ++v)
                for (int u = x * n; u < std::min((x + 1) * n, image.width); ++u)
                    sum += image.rgb(u, v), ++count;
            small.set_rgb(x, y, sum / float(count));
        }
    return small;
}

std::vector<std::uint8_t> encode_jpeg(const Image& shown, int quality) {
    LUXEL_ASSERT(shown.channels == 3 && !shown.empty(), "channels={}", shown.channels);
    jpeg_compress_struct jpeg{};
    jpeg_error_mgr errors{};
    jpeg.err = jpeg_std_error(&errors);
    jpeg_create_compress(&jpeg);
    unsigned char* bytes = nullptr;
    unsigned long size = 0;
    jpeg_mem_dest(&jpeg, &bytes, &size);

    jpeg.image_width = JDIMENSION(shown.width);
    jpeg.image_height = JDIMENSION(shown.height);
    jpeg.input_components = 3;
    jpeg.in_color_space = JCS_RGB;
    jpeg_set_defaults(&jpeg);
    jpeg_set_quality(&jpeg, quality, TRUE);
    jpeg.optimize_coding = TRUE;
    jpeg_start_compress(&jpeg, TRUE);
    std::vector<JSAMPLE> row(std::size_t(shown.width) * 3);
    for (int y = 0; y < shown.height; ++y) {
        const float* values = shown.at(0, y);
        for (std::size_t i = 0; i < row.size(); ++i)
            row[i] = JSAMPLE(std::lround(255.0f * std::clamp(values[i], 0.0f, 1.0f)));
        JSAMPROW rows[] = {row.data()};
        jpeg_write_scanlines(&jpeg, rows, 1);
    }
    jpeg_finish_compress(&jpeg);
    jpeg_destroy_compress(&jpeg);

    std::vector<std::uint8_t> out(bytes, bytes + size);
    std::free(bytes);
    return out;
}

std::string jpeg_uri(const Image& shown, int quality) {
    constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const std::vector<std::uint8_t> bytes = encode_jpeg(shown, quality);
    std::string uri = "data:image/jpeg;base64,";
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t word = 0;
        for (std::size_t k = 0; k < 3; ++k) word = word << 8 | (i + k < bytes.size() ? bytes[i + k] : 0u);
        for (std::size_t k = 0; k < 4; ++k)
            uri += i + k <= bytes.size() ? digits[word >> (18 - 6 * k) & 63u] : '=';
    }
    return uri;
}

} // namespace luxel
