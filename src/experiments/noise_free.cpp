// SPDX-License-Identifier: MIT
#include "experiments/noise_free.h"

#include <cmath>

#include "core/metrics.h"
#include "core/parallel.h"

namespace luxel {
namespace {

constexpr double BiasedFigures::*members[] = {
    &BiasedFigures::baseline_delta, &BiasedFigures::delta, &BiasedFigures::rho,    &BiasedFigures::improved,
    &BiasedFigures::tied,           &BiasedFigures::mse,   &BiasedFigures::relmse, &BiasedFigures::shown_mse};

BiasedFigures against(const Candidate& truth, const Image& mask, const Candidate& baseline,
                      const Candidate& candidate) {
    const Improvement closer = improvement(truth.shown, baseline.shown, candidate.shown, mask);
    const double root = rmse(truth.radiance, candidate.radiance, mask),
                 shown_root = rmse(truth.shown, candidate.shown, mask);
    return {.baseline_delta = mean_error(truth.shown, baseline.shown, mask),
            .delta = mean_error(truth.shown, candidate.shown, mask),
            .rho = correlation(truth.shown, candidate.shown, mask),
            .improved = closer.improved,
            .tied = closer.tied,
            .mse = root * root,
            .relmse = relmse(truth.radiance, candidate.radiance, mask),
            .shown_mse = shown_root * shown_root};
}

BiasedFigures combination(const BiasedFigures& all, double w_all, const BiasedFigures& halves,
                          double w_halves, const BiasedFigures& quarters, double w_quarters) {
    BiasedFigures sum;
    for (double BiasedFigures::*member : members)
        sum.*member = w_all * all.*member + w_halves * halves.*member + w_quarters * quarters.*member;
    return sum;
}

BiasedFigures mean_of(const std::vector<BiasedFigures>& figures) {
    BiasedFigures mean;
    for (const BiasedFigures& f : figures)
        for (double BiasedFigures::*member : members) mean.*member += f.*member / double(figures.size());
    return mean;
}

double gain_of(const BiasedFigures& f) { return gain(f.baseline_delta, f.delta); }
double delta_of(const BiasedFigures& f) { return f.delta; }

// From all of the samples, and two steps on.
struct Extrapolation {
    BiasedFigures all, first_order, second_order;
};

// Standard error of one figure. The groups are independent, so the scatter of what they say tells that of the
// mean. What the second order moves counts as uncertain, and so does a quarter of the whole way, for the
// terms that three points cannot tell.
double standard_error(double (*figure)(const BiasedFigures&), const std::vector<BiasedFigures>& groups,
                      const Extrapolation& e) {
    const double n = double(groups.size());
    double mean = 0.0, squares = 0.0;
    for (const BiasedFigures& f : groups) mean += figure(f) / n;
    for (const BiasedFigures& f : groups) squares += (figure(f) - mean) * (figure(f) - mean);
    const double second = figure(e.second_order) - figure(e.first_order),
                 higher = (figure(e.second_order) - figure(e.all)) / 4.0;
    return std::sqrt(squares / (n * (n - 1.0)) + second * second + higher * higher);
}

} // namespace

// Bias falls as a/n + b/n^2 with the samples n: figures from all, half and a quarter of them tell both terms,
// and where they lead as n grows [Quenouille1956].
NoiseFree noise_free_figures(const Target& target, const Candidate& baseline, const Candidate& candidate) {
    const auto against_each = [&](const std::vector<Candidate>& truths) {
        std::vector<BiasedFigures> figures(truths.size());
        parallel_for(truths.size(), 1, [&](std::size_t i) {
            figures[i] = against(truths[i], target.mask, baseline, candidate);
        });
        return figures;
    };
    const BiasedFigures all = against({target.radiance, target.shown}, target.mask, baseline, candidate);
    if (target.quarters.empty()) return {all, 0.0, 0.0};
    const std::vector<BiasedFigures> groups = against_each(target.quarters);
    const BiasedFigures halves = mean_of(against_each(target.halves)), quarters = mean_of(groups);

    const BiasedFigures first_order = combination(all, 2.0, halves, -1.0, quarters, 0.0);
    const BiasedFigures second_order = combination(all, 8.0 / 3.0, halves, -2.0, quarters, 1.0 / 3.0);
    const Extrapolation extrapolation = {all, first_order, second_order};
    return {second_order, standard_error(gain_of, groups, extrapolation),
            standard_error(delta_of, groups, extrapolation)};
}

} // namespace luxel
