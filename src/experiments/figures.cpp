// SPDX-License-Identifier: MIT
#include "experiments/figures.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "core/flip.h"
#include "core/metrics.h"
#include "experiments/components.h"
#include "experiments/noise_free.h"

namespace luxel {

namespace {

Image average(const Image& a, const Image& b) {
    Image mean = a;
    for (std::size_t i = 0; i < mean.data.size(); ++i) mean.data[i] = 0.5f * (a.data[i] + b.data[i]);
    return mean;
}

} // namespace

Image shown_of(const Image& image, float exposure) {
    if (image.channels > 1) return display(image, exposure);
    Image gray(image.width, image.height, 3);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            gray.set_rgb(x, y, glm::vec3(std::clamp(*image.at(x, y), 0.0f, 1.0f)));
    return gray;
}

Target make_target(const Truth& truth, const std::vector<std::string>& components, const Image& frame_mask) {
    Target target;
    target.radiance = sum_of(truth.mean, components);
    target.mask = truth.mask;
    for (std::size_t i = 0; i < target.mask.data.size(); ++i)
        target.mask.data[i] = truth.mask.data[i] > 0 && frame_mask.data[i] > 0 ? 1.0f : 0.0f;
    if (!is_accessibility(components)) target.exposure = exposure_of(target.radiance, target.mask);
    target.shown = shown_of(target.radiance, target.exposure);

    // Fewer samples: each group alone, and each pair of groups.
    for (const Layers& group : truth.group) {
        if (group.empty()) return target;
        target.quarters.push_back(make_candidate(target, sum_of(group, components)));
    }
    for (std::size_t i = 0; i < target.quarters.size(); ++i)
        for (std::size_t j = i + 1; j < target.quarters.size(); ++j)
            target.halves.push_back(
                make_candidate(target, average(target.quarters[i].radiance, target.quarters[j].radiance)));

    // The mean of two halves errs half as much as the halves differ: first and last pair share no group.
    target.noise = 0.5 * mean_error(target.halves.front().shown, target.halves.back().shown, target.mask);
    return target;
}

Candidate make_candidate(const Target& target, Image radiance) {
    Image shown = shown_of(radiance, target.exposure);
    return {std::move(radiance), std::move(shown)};
}

Figures measure(const Target& target, const Candidate& baseline, const Candidate& candidate) {
    const Image& shown = candidate.shown;
    const NoiseFree noise_free = noise_free_figures(target, baseline, candidate);
    const BiasedFigures& best = noise_free.figures;

    Figures f;
    f.delta = best.delta;
    f.delta_error = noise_free.delta_error;
    f.gain = gain(best.baseline_delta, f.delta);
    f.gain_error = noise_free.gain_error;
    f.rho = std::clamp(best.rho, -1.0, 1.0);
    f.improved = std::clamp(best.improved, 0.0, 1.0);
    f.tied = std::clamp(best.tied, 0.0, 1.0 - f.improved);
    f.quality = quality(f.delta, best.baseline_delta);
    f.rmse = std::sqrt(std::max(best.mse, 0.0));
    f.relmse = std::max(best.relmse, 0.0);
    f.psnr =
        best.shown_mse > 0.0 ? -10.0 * std::log10(best.shown_mse) : std::numeric_limits<double>::infinity();
    f.ssim = ssim(target.shown, shown, target.mask);
    f.flip = flip_ldr(target.shown, shown, target.mask).mean;
    return f;
}

Figures mean_of(const std::vector<Figures>& figures) {
    constexpr double Figures::*members[] = {&Figures::delta,    &Figures::gain,   &Figures::rho,
                                            &Figures::improved, &Figures::tied,   &Figures::quality,
                                            &Figures::rmse,     &Figures::relmse, &Figures::psnr,
                                            &Figures::ssim,     &Figures::flip};
    Figures mean;
    double squares = 0, delta_squares = 0; // the views' errors are independent
    for (const Figures& f : figures) {
        for (double Figures::*member : members) mean.*member += f.*member / double(figures.size());
        squares += f.gain_error * f.gain_error;
        delta_squares += f.delta_error * f.delta_error;
    }
    mean.delta_error = std::sqrt(delta_squares) / double(figures.size());
    mean.gain_error = std::sqrt(squares) / double(figures.size());
    return mean;
}

} // namespace luxel
