// SPDX-License-Identifier: MIT
// How far an image is from another. Definitions: docs/metrics.md.
#pragma once
#include "core/image.h"

namespace luxel {

// On linear radiance; mask (1 channel) may be empty; pixels with mask <= 0 are left out.
double rmse(const Image& reference, const Image& image, const Image& mask);
double relmse(const Image& reference, const Image& image, const Image& mask); // (x - r)^2 / (r^2 + .01), mean
// On display-referred values in [0, 1].
double mean_error(const Image& reference, const Image& image, const Image& mask); // delta [Rohleder2010, eq. 19]
double correlation(const Image& reference, const Image& image, const Image& mask); // rho, eq. 20, luminance eq. 17
double psnr(const Image& reference, const Image& image, const Image& mask);       // dB; infinity when equal
double ssim(const Image& reference, const Image& image, const Image& mask);       // [Wang2004] 11x11 Gaussian, sigma 1.5
// Sign of the comparison: 1 = `a` closer, -1 = `b` closer, 0 = equal [Rohleder2010, eq. 21].
int quality(double delta_a, double delta_b);
// 100 (delta_baseline - delta) / delta_baseline; 0 when the baseline is exact.
double gain(double delta_baseline, double delta);

// Share of pixels strictly closer to the reference than the baseline, and of ties, on display values (the
// distance is the mean absolute difference of the channels).
struct Improvement {
    double improved = 0, tied = 0; // in [0, 1] of the unmasked pixels
};
Improvement improvement(const Image& reference, const Image& baseline, const Image& image, const Image& mask);

// Negative of the absolute difference, 1 - |a - b| [Rohleder2010, eq. 18].
Image difference_picture(const Image& a, const Image& b);

} // namespace luxel
