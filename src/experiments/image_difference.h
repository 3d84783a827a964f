// SPDX-License-Identifier: MIT
// Two image files held against each other, for pictures that luxel did not make as well as for its own.
#pragma once
#include <filesystem>
#include <optional>
#include <string>

#include "core/flip.h"
#include "experiments/figures.h"
#include "experiments/picture_settings.h"

namespace luxel {

struct ImageFile {
    Image image, mask;          // mask: the layer of that name, else all ones
    Image alpha;                // 1 channel; empty: opaque
    bool radiance = false;      // linear (.exr, .hdr); otherwise display values as they are stored
    bool accessibility = false; // the truth of occlusion: one channel, shown as it is
    std::array<Image, sample_groups>
        groups; // means of independent groups of samples; empty: nothing is known of noise
    Attributes attributes;
    std::vector<std::string> warnings;
};
// By content. layer: of an EXR; "" = the unnamed one, or the only one. Error Fault::usage: no such layer.
ImageFile read_image_file(const std::filesystem::path& file, const std::string& layer);

struct AlphaDifference {
    std::size_t differing = 0; // pixels
    double delta = 0;          // mean absolute difference over all pixels
};

struct Difference {
    Figures
        figures; // against the baseline when there is one; the noise of a reference with groups is taken out
    FlipResult flip; // LDR, on display values
    std::optional<FlipResult> flip_hdr;
    double evaluator_flip = 0,
           evaluator_flip_hdr = 0; // the maps' means as the published evaluator adds them up
    float exposure = 1;            // of the display values; 1 for display-referred files
    std::optional<double> noise;   // of the reference's pixels, see Target; nothing where it is not known
    std::size_t counted = 0, pixels = 0; // inside every mask; all
    std::size_t not_finite = 0;          // pixels that count and are NaN or infinite in some picture
    AlphaDifference alpha;
    Image picture;                     // negative difference of display values, white outside the masks
    std::vector<std::string> warnings; // what the figures leave out, and in what the pictures are not alike
};
// Error Fault::bad_input: sizes or kinds differ.
Difference difference(const std::filesystem::path& reference, const std::filesystem::path& image,
                      const std::optional<std::filesystem::path>& baseline, const std::string& layer);

} // namespace luxel
