// SPDX-License-Identifier: MIT
// results.json; the schema is in docs/results-schema.md.
#pragma once
#include <nlohmann/json.hpp>

#include "experiments/evaluation.h"

namespace luxel {

inline constexpr int results_schema_version = 1;

nlohmann::ordered_json to_json(const EvaluationResult& result);

// Numbers and flags as such, everything else as text.
nlohmann::ordered_json typed_value(const ParameterInfo& parameter);

// Parameters and their values as one object.
nlohmann::ordered_json to_json(const std::vector<ParameterInfo>& parameters);

} // namespace luxel
