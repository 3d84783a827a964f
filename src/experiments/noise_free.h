// SPDX-License-Identifier: MIT
// The figures that a noisy truth biases, as they would be against the truth without its noise.
#pragma once
#include "experiments/figures.h"

namespace luxel {

struct BiasedFigures {
    double baseline_delta = 0, delta = 0, rho = 0, improved = 0, tied = 0;
    double mse = 0, relmse = 0; // of radiance
    double shown_mse = 0;       // of display values
};

struct NoiseFree {
    BiasedFigures figures;
    double gain_error = 0;  // standard error of the gain, percent
    double delta_error = 0; // and of delta
};

// Extrapolated from all, half and a quarter of the target's samples. Not clamped: a share may leave [0, 1]
// and an error fall below 0 where noise is large.
NoiseFree noise_free_figures(const Target& target, const Candidate& baseline, const Candidate& candidate);

} // namespace luxel
