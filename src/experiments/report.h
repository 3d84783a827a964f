// SPDX-License-Identifier: MIT
// The self-contained page of an evaluation: everything inline, nothing fetched.
#pragma once
#include <span>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

namespace luxel {

// results: as in results.json. pictures: per scene, per view what page_view() makes, or null.
std::string report_page(const nlohmann::ordered_json& results, const nlohmann::ordered_json& pictures);

// The page's parts, the files in report/, which the build embeds (cmake/luxel.cmake).
struct TextFile {
    std::string_view name, text;
};
std::span<const TextFile> text_files();

} // namespace luxel
