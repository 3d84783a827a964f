// SPDX-License-Identifier: MIT
// What an evaluation leaves behind: images/, results.json, report.html.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "experiments/evaluation.h"

namespace luxel {

class ResultFiles {
public:
    ResultFiles(std::filesystem::path folder, const std::vector<TechniqueRow>& rows);
    // Writes the view's images and keeps small copies for the page.
    void add(const ViewPictures& pictures);
    void finish(const EvaluationResult& result) const;

private:
    std::filesystem::path folder_;
    std::vector<std::string> file_names_;  // per row, all different
    nlohmann::ordered_json page_pictures_; // per view: {reference, rows: [{image, error, change}]}
};

} // namespace luxel
