// SPDX-License-Identifier: MIT
// Pictures for people: false-color maps, and small JPEGs that a page can hold.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "core/image.h"

namespace luxel {

// The full scale of the maps below, in display values; the report's legends say the same.
inline constexpr double error_scale = 0.25, change_scale = 0.1;

// Mean absolute difference of the channels, from white (equal) over orange to black (>= error_scale).
Image error_map(const Image& shown_reference, const Image& shown, const Image& mask);
// How much closer (blue) or farther (red) than the baseline a pixel is; white = as far.
Image change_map(const Image& shown_reference, const Image& shown_baseline, const Image& shown,
                 const Image& mask);

// Averages whole blocks until the image is at most `width` wide.
Image shrink(const Image& image, int width);

// Display values [0, 1], 3 channels; quality 0 to 100.
std::vector<std::uint8_t> encode_jpeg(const Image& shown, int quality);
// "data:image/jpeg;base64,..."
std::string jpeg_uri(const Image& shown, int quality);

} // namespace luxel
