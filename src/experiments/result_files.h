// SPDX-License-Identifier: MIT
// What an experiment leaves behind: images/, results.csv, results.json, report.html.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "experiments/experiment.h"

namespace luxel {

// Writes the pictures of views as they come.
class PictureFiles {
public:
    PictureFiles(std::filesystem::path folder, const Experiment& experiment);
    // By the experiment's picture mode, the view's images go to images/VIEW, or images/SCENE/VIEW where there
    // are several scenes. Returns small copies for the page, see page_view.h, or
    // null.
    nlohmann::ordered_json add(const SceneEntry& entry, const ViewPictures& pictures) const;

private:
    void write(const std::filesystem::path& folder, const ViewPictures& pictures) const;
    std::filesystem::path folder_;
    PictureMode mode_;
    int page_width_;
    bool many_scenes_;
    std::vector<std::string> file_names_; // per row, all different
};

// results.csv, results.json, report.html.
void write_results(const std::filesystem::path& folder, const ExperimentResult& result);

} // namespace luxel
