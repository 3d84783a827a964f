// SPDX-License-Identifier: MIT
// Gains against a noisy truth: what the noise adds is taken out, and what remains uncertain is stated.
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "core/metrics.h"
#include "experiments/noise_free.h"

namespace luxel {
namespace {

constexpr int side = 96;

// A smooth truth, an image that lacks a fifth of it everywhere, and a baseline that lacks half.
Image truth_radiance() {
    Image image(side, side, 3);
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x)
            image.set_rgb(x, y,
                          glm::vec3(0.1f + 0.4f * float(x) / side, 0.3f, 0.1f + 0.5f * float(y) / side));
    return image;
}
Image scaled(Image image, float factor) {
    for (float& v : image.data) v *= factor;
    return image;
}

// A truth of `spp` samples of which each is bright with the given chance and else black, as where light comes
// from a small patch.
Truth noisy_truth(int spp, double chance, unsigned seed) {
    const Image exact = truth_radiance();
    std::mt19937 random(seed);
    std::binomial_distribution<int> hits(spp / sample_groups, chance);
    Truth truth;
    truth.spp = spp;
    truth.mask = Image(side, side, 1, 1.0f);
    Image& mean = truth.mean["direct"] = Image(side, side, 3);
    for (Layers& group : truth.group) {
        Image& image = group["direct"] = Image(side, side, 3);
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x)
                image.set_rgb(x, y, exact.rgb(x, y) * float(hits(random) / (chance * spp / sample_groups)));
        for (std::size_t i = 0; i < mean.data.size(); ++i) mean.data[i] += image.data[i] / sample_groups;
    }
    return truth;
}

struct Held {
    Figures figures;
    double plain_gain;
};
Held hold_against(const Truth& truth) {
    const Target target = make_target(truth, {"direct"}, Image(side, side, 1, 1.0f));
    const Candidate baseline = make_candidate(target, scaled(truth_radiance(), 0.5f)),
                    image = make_candidate(target, scaled(truth_radiance(), 0.8f));
    return {measure(target, baseline, image), gain(mean_error(target.shown, baseline.shown, target.mask),
                                                   mean_error(target.shown, image.shown, target.mask))};
}

Truth exact_truth() { return noisy_truth(sample_groups, 1.0, 1); }

TEST(NoiseFree, LeavesAnExactTruthAlone) {
    const Held held = hold_against(exact_truth());
    EXPECT_NEAR(held.figures.gain, held.plain_gain, 1e-9);
    EXPECT_NEAR(held.figures.gain_error, 0.0, 1e-9);
    EXPECT_EQ(held.figures.improved, 1.0);
    EXPECT_TRUE(is_claimed(held.figures));
}

// At a relative noise of 30 to 60 % of each pixel.
TEST(NoiseFree, RecoversTheGainOfTheExactTruth) {
    const double exact = hold_against(exact_truth()).plain_gain;
    for (int spp : {64, 128, 256}) {
        double plain = 0.0, corrected = 0.0, worst = 0.0;
        constexpr int runs = 6;
        for (unsigned seed = 1; seed <= runs; ++seed) {
            const Held held = hold_against(noisy_truth(spp, 0.05, seed));
            plain += (held.plain_gain - exact) / runs;
            corrected += (held.figures.gain - exact) / runs;
            worst = std::max(worst, std::abs(held.figures.gain - exact) / held.figures.gain_error);
        }
        EXPECT_LT(std::abs(corrected), 0.25 * std::abs(plain)) << spp;
        EXPECT_LT(worst, 3.3) << spp << ": the stated error covers the true one";
    }
}

// Where a sample rarely meets the light, nothing is known yet, and nothing is claimed.
TEST(NoiseFree, ClaimsNothingFromNoiseAlone) {
    for (unsigned seed = 1; seed <= 4; ++seed) {
        const Held held = hold_against(noisy_truth(16, 0.02, seed));
        EXPECT_GT(held.figures.gain_error, 2.0) << held.figures.gain;
    }
}

TEST(NoiseFree, TakesTheTruthsVarianceOutOfTheSquaredErrors) {
    const double exact = hold_against(exact_truth()).figures.rmse;
    const Held noisy = hold_against(noisy_truth(128, 0.05, 3));
    EXPECT_NEAR(noisy.figures.rmse, exact, 0.05 * exact);
}

} // namespace
} // namespace luxel
