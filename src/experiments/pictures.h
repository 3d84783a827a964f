// SPDX-License-Identifier: MIT
// Pictures for people: false-color maps, and small JPEGs that a page can hold.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "core/image.h"

namespace luxel {

// The full scale of the maps below, in display values; the report's legends say the same.
inline constexpr double error_scale = 0.25, signed_scale = 0.25, flip_scale = 0.5, change_scale = 0.1;
// White of bright_picture(), over white of a view's own exposure.
inline constexpr double bright_scale = 16.0;

// Mean absolute difference of the channels, from white (equal) over orange to black (>= error_scale).
Image error_map(const Image& shown_reference, const Image& shown, const Image& mask);
// Mean signed difference of the channels: red where it is brighter than the reference, blue where darker,
// white = equal.
Image signed_map(const Image& shown_reference, const Image& shown, const Image& mask);
// FLIP's own map in the colors of the error map; `flip` has one channel.
Image flip_picture(const Image& flip, const Image& mask);
// How much closer (blue) or farther (red) than the baseline a pixel is; white = as far.
Image change_map(const Image& shown_reference, const Image& shown_baseline, const Image& shown,
                 const Image& mask);

// Radiance whose `bright_scale`-fold is still below white: what the display values of the same exposure cut
// off. Empty where they cut nothing off.
Image bright_picture(const Image& radiance, float exposure);

// Averages whole blocks until the image is at most `width` wide.
Image shrink(const Image& image, int width);

// Display values [0, 1], 3 channels; quality 0 to 100.
std::vector<std::uint8_t> encode_jpeg(const Image& shown, int quality);
// "data:image/jpeg;base64,..."
std::string jpeg_uri(const Image& shown, int quality);

} // namespace luxel
