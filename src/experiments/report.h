// SPDX-License-Identifier: MIT
// The self-contained page of an evaluation: everything inline, nothing fetched.
#pragma once
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

namespace luxel {

// results: as in results.json. pictures: per scene, per view {reference, rows: [{image, error, change}]} as
// data URIs, or null.
std::string report_page(const nlohmann::ordered_json& results, const nlohmann::ordered_json& pictures);

// The page's parts, in files of their own.
std::string_view report_style();
std::string_view report_script(); // data, state and tables
std::string_view report_charts();
std::string_view report_viewer(); // pictures side by side and under a slider; the page put together
} // namespace luxel
