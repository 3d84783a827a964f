// SPDX-License-Identifier: MIT
// Reference images stored by content: what the same scene, camera and settings computed before is read, not
// rendered.
#pragma once
#include <array>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "reference/reference.h"

namespace luxel {

// What evaluation needs of an Estimate.
struct Truth {
    int spp = 0;
    double seconds = 0; // that the rendering took, when it was rendered
    bool cached = false;
    bool complete = true; // false: it was stopped before it had all its samples
    Layers mean;
    std::array<Layers, sample_groups> group; // as in Estimate
    Image mask;
};

// $XDG_CACHE_HOME/luxel, or ~/.cache/luxel; empty when neither variable is set.
std::filesystem::path default_cache_folder();

// Scene and request to 16 hexadecimal digits.
std::string reference_key(const Scene& scene, const ReferenceRequest& request);

// One file: header, key, checksum, images. load returns nothing when there is none; a file that is damaged or
// of another key gives nothing and a sentence in `warnings`.
std::optional<Truth> load_truth(const std::filesystem::path& file, const std::string& key,
                                std::vector<std::string>& warnings);
void store_truth(const std::filesystem::path& file, const std::string& key, const Truth& truth);

// Called with the number of samples that there are; false: stop.
using TruthWatch = std::function<bool(int spp)>;

// Size, samples and components of the truth in a file, from its first bytes; nothing where it is damaged.
struct CachedFile;
void describe_truth(CachedFile& file);

// Rendered, or found in `folder` (empty: no cache). One that is stopped leaves a checkpoint there, from which
// the next call goes on. A cache that cannot be written is a warning.
Truth find_truth(const RayCaster& rays, const ReferenceRequest& request, const std::filesystem::path& folder,
                 std::vector<std::string>& warnings, const TruthWatch& watch = {});

// The same for any renderer: `key` says all that its image depends on.
Truth find_truth(const std::string& key, const std::filesystem::path& folder,
                 std::vector<std::string>& warnings, const std::function<Truth()>& render);

} // namespace luxel
