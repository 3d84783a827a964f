// SPDX-License-Identifier: MIT
// Running sums of a view: per pixel and channel each group of samples and all squares.
#pragma once
#include <string>
#include <vector>

#include "reference/path_tracer.h"

namespace luxel {

class Film {
public:
    Film(int width, int height, std::vector<std::string> components);

    // One thread per pixel at a time; samples in order. Samples that are not finite count as black.
    void add(int x, int y, int sample, const PathSample& value);
    Estimate estimate(int spp) const; // without the mask

    // The whole state, for checkpoints.
    std::vector<double>& sums() { return sums_; }
    const std::vector<double>& sums() const { return sums_; }

private:
    int width_, height_;
    std::vector<std::string> components_;
    std::vector<int> channels_;
    std::size_t stride_ = 0; // doubles per pixel: sums_per_channel for each channel of each component
    std::vector<double> sums_;
};

} // namespace luxel
