// SPDX-License-Identifier: MIT
// What follows --use: one row of an evaluation, a technique or several of different slots joined by "+".
#pragma once
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "techniques/technique.h"

namespace luxel {

struct TechniqueRow {
    std::string label; // as typed: "ssao+isr:samples=24"
    std::string name;  // "ssao+isr"
    std::vector<std::unique_ptr<Technique>> techniques;
    // Every parameter with its value; "technique.parameter" when the row joins several.
    std::vector<ParameterInfo> parameters;
    std::vector<std::string> warnings{}; // of values that have no effect
    bool of_all = false;                 // by "--use all": left out of the results where it cannot act
    std::string idle{};                  // why it cannot act in the scene at hand: "it needs a light"
};

// The row that every other is held against: direct light alone.
inline constexpr std::string_view baseline_name = "direct";
TechniqueRow baseline_row();

// Error Fault::usage: unknown technique or parameter, two techniques in one slot.
TechniqueRow parse_use(std::string_view text);
// The row with one more parameter; `key` is "technique.parameter" where the row joins several. Error
// Fault::usage: no such technique in the row.
std::string with_parameter(std::string_view use, std::string_view key, std::string_view value);
// The baseline, then one row each; "all" stands for every technique with its defaults. Error Fault::usage
// when two are the same.
inline constexpr std::string_view all_uses = "all";
std::vector<TechniqueRow> parse_uses(const std::vector<std::string>& texts);

// Sets `idle` of the rows none of whose techniques can act.
void mark_idle(std::vector<TechniqueRow>& rows, const Scene& scene, const FrameOptions& frame);
// The same of each technique that is idle in a row that can act, a sentence each.
std::vector<std::string> idle_parts(const TechniqueRow& row, const Scene& scene, const FrameOptions& frame);

// What the row computes at best: direct light and its techniques' components, those left out that another of
// them contains.
std::vector<std::string> own_components(const TechniqueRow& row);

} // namespace luxel
