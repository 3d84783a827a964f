// SPDX-License-Identifier: MIT
#include "experiments/figures.h"

#include <algorithm>

#include "core/error.h"
#include "core/flip.h"
#include "core/metrics.h"
#include "experiments/components.h"

namespace luxel {

namespace {

double mean_inside(const Image& map, const Image& mask) {
    double sum = 0, count = 0;
    for (std::size_t i = 0; i < mask.data.size(); ++i)
        if (mask.data[i] > 0) sum += map.data[i], ++count;
    return count > 0 ? sum / count : 0.0;
}

} // namespace

Image fill_outside(Image image, const Image& background, const Image& mask) {
    LUXEL_ASSERT(image.data.size() == background.data.size() && image.pixels() == mask.pixels(), "{}x{}",
                 image.width, image.height);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            if (mask.at(x, y)[0] <= 0)
                for (int c = 0; c < image.channels; ++c) image.at(x, y)[c] = background.at(x, y)[c];
    return image;
}

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

    // The mean of two halves errs half as much as the halves differ.
    const Image even = shown_of(sum_of(truth.half[0], components), target.exposure);
    const Image odd = shown_of(sum_of(truth.half[1], components), target.exposure);
    target.noise = 0.5 * mean_error(even, odd, target.mask);
    return target;
}

Candidate make_candidate(const Target& target, Image radiance) {
    Image shown = shown_of(radiance, target.exposure);
    return {std::move(radiance), std::move(shown)};
}

Figures measure(const Target& target, const Candidate& baseline, const Candidate& candidate) {
    const Image& shown = candidate.shown;
    const double baseline_delta = mean_error(target.shown, baseline.shown, target.mask);
    const Improvement closer = improvement(target.shown, baseline.shown, shown, target.mask);

    Figures f;
    f.delta = mean_error(target.shown, shown, target.mask);
    f.gain = gain(baseline_delta, f.delta);
    f.rho = correlation(target.shown, shown, target.mask);
    f.improved = closer.improved;
    f.tied = closer.tied;
    f.quality = quality(f.delta, baseline_delta);
    f.rmse = rmse(target.radiance, candidate.radiance, target.mask);
    f.relmse = relmse(target.radiance, candidate.radiance, target.mask);
    f.psnr = psnr(target.shown, shown, target.mask);
    f.ssim = ssim(target.shown, shown, target.mask);
    // FLIP filters over neighbors: outside, both images are made the same.
    f.flip =
        mean_inside(flip_ldr(target.shown, fill_outside(shown, target.shown, target.mask)).map, target.mask);
    return f;
}

Figures mean_of(const std::vector<Figures>& figures) {
    constexpr double Figures::*members[] = {&Figures::delta,    &Figures::gain,   &Figures::rho,
                                            &Figures::improved, &Figures::tied,   &Figures::quality,
                                            &Figures::rmse,     &Figures::relmse, &Figures::psnr,
                                            &Figures::ssim,     &Figures::flip};
    Figures mean;
    for (const Figures& f : figures)
        for (double Figures::*member : members) mean.*member += f.*member / double(figures.size());
    return mean;
}

} // namespace luxel
