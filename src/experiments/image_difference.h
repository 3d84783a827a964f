// SPDX-License-Identifier: MIT
// Two image files held against each other, for pictures that luxel did not make as well as for its own.
#pragma once
#include <filesystem>
#include <optional>
#include <string>

#include "core/flip.h"
#include "experiments/figures.h"

namespace luxel {

struct ImageFile {
    Image image, mask;     // mask: the layer of that name, else all ones
    bool radiance = false; // linear (.exr, .hdr); otherwise display values as they are stored
};
// By content. layer: of an EXR; "" = the unnamed one, or the only one. Error Fault::usage: no such layer.
ImageFile read_image_file(const std::filesystem::path& file, const std::string& layer);

struct Difference {
    Figures figures; // against the baseline when there is one
    FlipResult flip; // LDR, on display values, whole image
    std::optional<FlipResult> flip_hdr;
    double evaluator_flip = 0,
           evaluator_flip_hdr = 0; // the maps' means as the published evaluator adds them up
    float exposure = 1;            // of the display values; 1 for display-referred files
    Image picture;                 // negative difference of display values
};
// Error Fault::bad_input: sizes or kinds differ.
Difference difference(const std::filesystem::path& reference, const std::filesystem::path& image,
                      const std::optional<std::filesystem::path>& baseline, const std::string& layer);

} // namespace luxel
