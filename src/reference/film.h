// SPDX-License-Identifier: MIT
// Running sums of a view: per pixel and channel each group of samples and all squares.
#pragma once
#include <string>
#include <vector>

#include "reference/path_tracer.h"

namespace luxel {

class Film {
public:
    // by_photons: names of components that do not come with paths.
    Film(int width, int height, std::vector<std::string> components,
         const std::vector<std::string>& by_photons = {});

    // One thread per pixel at a time; samples in order. Samples that are not finite count as black.
    // What paths bring, all components but those by photons,
    void add(int x, int y, int sample, const PathSample& value);
    // and one component.
    void add(int x, int y, int sample, std::size_t component, glm::vec3 value);
    Estimate estimate(int spp) const; // without the mask

    // The whole state, for checkpoints.
    std::vector<double>& sums() { return sums_; }
    const std::vector<double>& sums() const { return sums_; }

private:
    int width_, height_;
    std::vector<std::string> components_;
    std::vector<int> channels_;
    std::vector<bool> by_photons_;
    std::vector<std::size_t> offset_; // of the component within a pixel
    std::size_t stride_ = 0; // doubles per pixel: sums_per_channel for each channel of each component
    std::vector<double> sums_;
};

} // namespace luxel
