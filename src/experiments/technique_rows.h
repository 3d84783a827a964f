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
};

// The row that every other is held against: direct light alone.
inline constexpr std::string_view baseline_name = "direct";
TechniqueRow baseline_row();

// Error Fault::usage: unknown technique or parameter, two techniques in one slot.
TechniqueRow parse_use(std::string_view text);
// The row with one more parameter; `key` is "technique.parameter" where the row joins several. Error
// Fault::usage: no such technique in the row.
std::string with_parameter(std::string_view use, std::string_view key, std::string_view value);
// The baseline, then one row each. Error Fault::usage when two are the same.
std::vector<TechniqueRow> parse_uses(const std::vector<std::string>& texts);

} // namespace luxel
