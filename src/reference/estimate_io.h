// SPDX-License-Identifier: MIT
// An estimate as one EXR file of floats. Layers of component C: "C" the mean, "C.variance" of the mean,
// "C.group0" to "C.group3" the groups of samples; "mask". The attribute "luxel.spp" holds the samples per
// pixel.
#pragma once
#include <filesystem>
#include <map>
#include <string>

#include "reference/reference.h"

namespace luxel {

// The layers of such a file.
Layers layers_of(const Estimate& estimate);
// The name of the layer of a group of samples of a component; "" = of an image that has no name.
std::string group_layer(const std::string& component, int group);

// metadata: further string attributes, for instance a content key to find the file by.
void write_estimate(const std::filesystem::path& file, const Estimate& estimate,
                    const std::map<std::string, std::string>& metadata = {});

struct StoredEstimate {
    Estimate estimate;
    std::map<std::string, std::string> metadata;
};
// Errors: those of read_exr, and Fault::bad_input for an EXR that is no estimate.
StoredEstimate read_estimate(const std::filesystem::path& file);

} // namespace luxel
