// SPDX-License-Identifier: MIT
#include "reference/film.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace luxel {
namespace {

constexpr int sums_per_channel = sample_groups + 1; // the last is of squares

glm::vec3 component_of(const PathSample& sample, const std::string& name) {
    if (name == "direct") return sample.direct;
    if (name == "diffuse1") return sample.diffuse1;
    if (name == "diffuse1_unoccluded") return sample.diffuse1_unoccluded;
    if (name == "diffuse") return sample.diffuse;
    if (name == "specular") return sample.specular;
    if (name == "reflections") return sample.reflections;
    if (name == "caustics") return sample.caustics;
    if (name == "full") return sample.full();
    if (name == "photon_bias") return sample.photon_bias;
    LUXEL_ASSERT(name == "ao", "component {}", name);
    return glm::vec3(sample.ao);
}

} // namespace

Film::Film(int width, int height, std::vector<std::string> components,
           const std::vector<std::string>& by_photons)
    : width_(width), height_(height), components_(std::move(components)) {
    for (const std::string& name : components_) {
        channels_.push_back(name == "ao" ? 1 : 3);
        by_photons_.push_back(std::find(by_photons.begin(), by_photons.end(), name) != by_photons.end());
        offset_.push_back(stride_);
        stride_ += std::size_t(channels_.back()) * std::size_t(sums_per_channel);
    }
    sums_.assign(std::size_t(width) * std::size_t(height) * stride_, 0.0);
}

void Film::add(int x, int y, int sample, const PathSample& value) {
    for (std::size_t c = 0; c < components_.size(); ++c)
        if (!by_photons_[c]) add(x, y, sample, c, component_of(value, components_[c]));
}

void Film::add(int x, int y, int sample, std::size_t component, glm::vec3 value) {
    double* at =
        &sums_[(std::size_t(y) * std::size_t(width_) + std::size_t(x)) * stride_ + offset_[component]];
    for (int k = 0; k < channels_[component]; ++k, at += sums_per_channel) {
        double d = std::isfinite(value[k]) ? double(value[k]) : 0.0;
        at[sample % sample_groups] += d;
        at[sample_groups] += d * d;
    }
}

Estimate Film::estimate(int spp) const {
    Estimate e;
    e.width = width_, e.height = height_, e.spp = spp;
    const double n = spp;
    for (std::size_t c = 0; c < components_.size(); ++c) {
        const std::size_t channels = std::size_t(channels_[c]);
        Image blank(width_, height_, channels_[c]);
        Image &mean = e.mean[components_[c]] = blank, &variance = e.variance[components_[c]] = blank;
        for (Layers& group : e.group) group[components_[c]] = blank;
        for (std::size_t i = 0; i < blank.data.size(); ++i) {
            const double* at = &sums_[i / channels * stride_ + offset_[c] + i % channels * sums_per_channel];
            double sum = 0.0;
            for (int g = 0; g < sample_groups; ++g) {
                const int samples = group_samples(spp, g);
                e.group[std::size_t(g)][components_[c]].data[i] = float(at[g] / std::max(samples, 1));
                sum += at[g];
            }
            mean.data[i] = float(sum / std::max(n, 1.0));
            variance.data[i] =
                n > 1.0 ? float(std::max(at[sample_groups] - sum * sum / n, 0.0) / (n * (n - 1.0))) : 0.0f;
        }
    }
    return e;
}

} // namespace luxel
