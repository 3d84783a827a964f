// SPDX-License-Identifier: MIT
// FLIP, the perceptual difference of alternating images: LDR [Andersson2020] and HDR [Andersson2021].
#pragma once
#include <numbers>

#include "core/image.h"

namespace luxel {

struct FlipResult {
    Image map; // 1 channel, [0, 1]
    double mean = 0, weighted_median = 0, max = 0;
};

// A display 3840 pixels and 0.7 m wide seen from 0.7 m: 67.02.
inline constexpr double flip_pixels_per_degree = 3840.0 * std::numbers::pi / 180.0;

// Display-referred sRGB values in [0, 1].
FlipResult flip_ldr(const Image& reference, const Image& test, double pixels_per_degree = flip_pixels_per_degree);

// Linear radiance; exposure range and count are derived from the reference, ACES tone mapping.
struct HdrExposures {
    double start, stop;
    int count;
};
HdrExposures flip_exposures(const Image& reference);
FlipResult flip_hdr(const Image& reference, const Image& test, double pixels_per_degree = flip_pixels_per_degree);

} // namespace luxel
