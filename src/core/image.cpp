// SPDX-License-Identifier: MIT
// The display transform and the exposure that all pictures of one view share.
#include "core/image.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/error.h"
#include "core/parallel.h"

namespace luxel {

float srgb_encode(float linear) {
    return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1.0f / 2.4f) - 0.055f;
}

float srgb_decode(float encoded) {
    return encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f);
}

Image display(const Image& radiance, float exposure) {
    Image shown(radiance.width, radiance.height, radiance.channels);
    const std::size_t row = std::size_t(radiance.width) * std::size_t(radiance.channels);
    parallel_for(std::size_t(radiance.height), 16, [&](std::size_t y) {
        for (std::size_t i = y * row; i < (y + 1) * row; ++i) {
            // Written so that NaN becomes black; alpha has no exposure and no curve.
            const bool alpha = radiance.channels == 4 && i % 4 == 3;
            const float value = alpha ? radiance.data[i] : exposure * radiance.data[i];
            const float clamped = value > 0.0f ? std::min(value, 1.0f) : 0.0f;
            shown.data[i] = alpha ? clamped : srgb_encode(clamped);
        }
    });
    return shown;
}

namespace {

constexpr int exposure_blocks = 48; // along the height

// The brightest channel of the mean of the pixels that count in one square of the image; nothing where none
// does.
std::optional<float> block_level(const Image& image, const Image& mask, int left, int top, int side) {
    glm::dvec3 sum(0.0);
    int count = 0;
    for (int y = top; y < std::min(top + side, image.height); ++y)
        for (int x = left; x < std::min(left + side, image.width); ++x) {
            if (!mask.empty() && !(*mask.at(x, y) > 0.0f)) continue;
            const glm::vec3 value = image.rgb(x, y);
            if (!std::isfinite(value.r + value.g + value.b)) continue;
            sum += glm::dvec3(glm::max(value, 0.0f)), ++count;
        }
    if (count == 0) return std::nullopt;
    return float(std::max({sum.r, sum.g, sum.b}) / count);
}

} // namespace

float exposure_of(const Image& reference, const Image& mask) {
    LUXEL_ASSERT(mask.empty() || (mask.width == reference.width && mask.height == reference.height),
                 "mask {}x{}, image {}x{}", mask.width, mask.height, reference.width, reference.height);
    // Blocks, not pixels: the bright end of a noisy image is its noise. The brightest channel, not the
    // luminance: under a blue lamp, whose luminance is small, the display would clip all but the dark.
    const int side = std::max(1, reference.height / exposure_blocks);
    std::vector<float> values;
    for (int y = 0; y < reference.height; y += side)
        for (int x = 0; x < reference.width; x += side)
            if (const auto value = block_level(reference, mask, x, y, side)) values.push_back(*value);

    // Where more than 98 % of the blocks are black, the percentile of the lit ones is meant.
    const auto percentile = [&values] {
        const std::size_t rank = std::size_t(std::ceil(0.98 * double(values.size()))) - 1;
        std::nth_element(values.begin(), values.begin() + std::ptrdiff_t(rank), values.end());
        return values[rank];
    };
    if (values.empty()) return 1.0f;
    if (const float white = percentile(); white > 0.0f) return 1.0f / white;
    std::erase_if(values, [](float value) { return value <= 0.0f; });
    return values.empty() ? 1.0f : 1.0f / percentile();
}

} // namespace luxel
