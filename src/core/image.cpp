// SPDX-License-Identifier: MIT
// The display transform and the exposure that all pictures of one view share.
#include "core/image.h"

#include <algorithm>
#include <cmath>

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

float exposure_of(const Image& reference, const Image& mask) {
    LUXEL_ASSERT(mask.empty() || (mask.width == reference.width && mask.height == reference.height),
                 "mask {}x{}, image {}x{}", mask.width, mask.height, reference.width, reference.height);
    std::vector<float> values;
    for (int y = 0; y < reference.height; ++y)
        for (int x = 0; x < reference.width; ++x) {
            if (!mask.empty() && !(*mask.at(x, y) > 0.0f)) continue;
            const float value = luminance(reference.rgb(x, y));
            if (std::isfinite(value)) values.push_back(std::max(value, 0.0f));
        }

    // Where more than 98 % of the pixels are black, the percentile of the lit ones is meant.
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
