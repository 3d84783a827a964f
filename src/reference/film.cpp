// SPDX-License-Identifier: MIT
#include "reference/film.h"

#include <cmath>

#include "core/error.h"

namespace luxel {
namespace {

glm::vec3 component_of(const PathSample& sample, const std::string& name) {
    if (name == "direct") return sample.direct;
    if (name == "diffuse1") return sample.diffuse1;
    if (name == "diffuse1_unoccluded") return sample.diffuse1_unoccluded;
    if (name == "diffuse") return sample.diffuse;
    if (name == "specular") return sample.specular;
    if (name == "full") return sample.full();
    LUXEL_ASSERT(name == "ao", "component {}", name);
    return glm::vec3(sample.ao);
}

} // namespace

Film::Film(int width, int height, std::vector<std::string> components)
    : width_(width), height_(height), components_(std::move(components)) {
    for (const std::string& name : components_) {
        channels_.push_back(name == "ao" ? 1 : 3);
        stride_ += std::size_t(channels_.back()) * 3;
    }
    sums_.assign(std::size_t(width) * std::size_t(height) * stride_, 0.0);
}

void Film::add(int x, int y, int sample, const PathSample& value) {
    double* at = &sums_[(std::size_t(y) * std::size_t(width_) + std::size_t(x)) * stride_];
    for (std::size_t c = 0; c < components_.size(); ++c) {
        glm::vec3 v = component_of(value, components_[c]);
        for (int k = 0; k < channels_[c]; ++k, at += 3) {
            double d = std::isfinite(v[k]) ? double(v[k]) : 0.0;
            at[sample & 1] += d;
            at[2] += d * d;
        }
    }
}

Estimate Film::estimate(int spp) const {
    Estimate e;
    e.width = width_, e.height = height_, e.spp = spp;
    const double n = spp, halves[2] = {double((spp + 1) / 2), double(spp / 2)};
    std::size_t first = 0; // offset of the component within a pixel
    for (std::size_t c = 0; c < components_.size(); ++c) {
        const std::size_t channels = std::size_t(channels_[c]);
        Image blank(width_, height_, channels_[c]);
        Image &mean = e.mean[components_[c]] = blank, &variance = e.variance[components_[c]] = blank;
        Image &even = e.half[0][components_[c]] = blank, &odd = e.half[1][components_[c]] = blank;
        for (std::size_t i = 0; i < blank.data.size(); ++i) {
            const double* at = &sums_[i / channels * stride_ + first + i % channels * 3];
            double sum = at[0] + at[1];
            mean.data[i] = float(sum / std::max(n, 1.0));
            variance.data[i] = n > 1.0 ? float(std::max(at[2] - sum * sum / n, 0.0) / (n * (n - 1.0))) : 0.0f;
            even.data[i] = float(at[0] / std::max(halves[0], 1.0));
            odd.data[i] = float(at[1] / std::max(halves[1], 1.0));
        }
        first += channels * 3;
    }
    return e;
}

} // namespace luxel
