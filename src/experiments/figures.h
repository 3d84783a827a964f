// SPDX-License-Identifier: MIT
// Every figure of one image against the truth, by the conventions of the evaluation: display-referred metrics
// share one exposure per view, background pixels are left out, RMSE and relMSE are on linear radiance. The
// truth is itself an estimate: what its noise adds to delta, gain, rho, the shares of pixels, RMSE and relMSE
// is taken out (docs/metrics.md, "Noise").
#pragma once
#include <vector>

#include "core/image.h"
#include "experiments/reference_cache.h"

namespace luxel {

struct Figures {
    double delta = 0;       // mean absolute error of display values
    double delta_error = 0; // standard error of it that the truth's noise leaves
    double gain = 0;        // percent of the baseline's delta that is gone
    double gain_error = 0;  // standard error of the gain that the truth's noise leaves, percent
    double rho = 0;         // correlation of luminance
    double improved = 0;    // share of pixels closer than the baseline's, in [0, 1]
    double tied = 0;        // share of pixels as close as the baseline's
    double quality = 0; // 1 closer than the baseline, -1 farther, 0 the same; a mean over views lies between
    double rmse = 0, relmse = 0;
    double psnr = 0; // dB; infinity for equal images
    double ssim = 0, flip = 0;
};

// An image as radiance and under the exposure of its view.
struct Candidate {
    Image radiance, shown;
};

// The truth of one view, ready to be held against.
struct Target {
    Image radiance, shown; // linear (accessibility: one channel); display-referred
    // The same from fewer samples: by all pairs of its groups, and by each group alone. Empty: no noise.
    std::vector<Candidate> halves, quarters;
    Image mask; // 1 where pixels count
    float exposure = 1;
    double noise = 0; // of single pixels: delta between two halves of the samples, halved
};

// mask: 1 where both the truth and the frame see a surface. A truth without groups has no noise.
Target make_target(const Truth& truth, const std::vector<std::string>& components, const Image& frame_mask);

Candidate make_candidate(const Target& target, Image radiance);

Figures measure(const Target& target, const Candidate& baseline, const Candidate& candidate);

// Display values: radiance under the exposure; accessibility, which has one channel, as it is, in gray.
Image shown_of(const Image& image, float exposure);

// A gain is claimed where the truth's noise explains it with less than 2.5 % probability.
inline bool is_claimed(const Figures& figures) { return figures.gain > 1.96 * figures.gain_error; }

Figures mean_of(const std::vector<Figures>& figures);

} // namespace luxel
