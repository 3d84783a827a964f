// SPDX-License-Identifier: MIT
// Finished views on disk, one file each, named by the content of everything that they depend on: whatever
// moment a run is killed at, a file is there whole or not at all.
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/descriptor.h"
#include "experiments/experiment.h"

namespace luxel {

// 16 hexadecimal digits of the scene's content, the view, the truth, the rows, the device and the program's
// version.
std::string view_key(const Experiment& experiment, const SceneEntry& entry, std::uint64_t scene_key,
                     const ViewTask& task, const std::vector<RowName>& rows, const gpu::DeviceInfo& device);
// Everything of a scene that frames and truths depend on.
std::uint64_t stage_key(const Scene& scene);

class Journal {
public:
    // An empty folder keeps nothing. What a killed run left half-written is removed. Error Fault::io where
    // another run is at work in the folder.
    explicit Journal(std::filesystem::path folder);
    // Nothing when the view is not finished; a damaged file is not either.
    std::optional<ViewResult> find(const std::string& key, const ViewTask& task) const;
    void store(const std::string& key, const std::vector<RowName>& rows, const ViewResult& view) const;
    // Finished views that were there at first, whatever they belong to.
    std::size_t files_before() const { return files_before_; }

private:
    std::filesystem::path folder_;
    Descriptor lock_;
    std::size_t files_before_ = 0;
};

} // namespace luxel
