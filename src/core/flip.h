// SPDX-License-Identifier: MIT
// FLIP, the perceptual difference of alternating images: LDR [Andersson2020] and HDR [Andersson2021].
#pragma once
#include <numbers>

#include "core/image.h"

namespace luxel {

struct FlipResult {
    Image map; // 1 channel, [0, 1]; 0 outside the mask
    double mean = 0, weighted_median = 0, max = 0;
};

// A display 3840 pixels and 0.7 m wide seen from 0.7 m: 67.02.
inline constexpr double flip_pixels_per_degree = 3840.0 * std::numbers::pi / 180.0;

// Display-referred sRGB values in [0, 1]. mask (1 channel, may be empty): outside it both images are taken to
// be equal, as the filters reach over its border, and the figures are of the pixels > 0.
FlipResult flip_ldr(const Image& reference, const Image& test, const Image& mask = {},
                    double pixels_per_degree = flip_pixels_per_degree);

// Linear radiance; exposure range and count are derived from the reference, ACES tone mapping.
struct HdrExposures {
    double start, stop;
    int count;
};
HdrExposures flip_exposures(const Image& reference, const Image& mask = {});
FlipResult flip_hdr(const Image& reference, const Image& test, const Image& mask = {},
                    double pixels_per_degree = flip_pixels_per_degree);

// The map's values at the pixels that count, row by row.
std::vector<float> inside(const Image& map, const Image& mask);

} // namespace luxel
