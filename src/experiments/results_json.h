// SPDX-License-Identifier: MIT
// results.json; the schema is in docs/results-schema.md.
#pragma once
#include <nlohmann/json.hpp>

#include "experiments/experiment.h"

namespace luxel {

inline constexpr int results_schema_version = 3;

// The figures of a row by their names in results.json and results.csv, in order.
struct FigureColumn {
    const char* name;
    double Figures::*member;
};
inline constexpr FigureColumn figure_columns[] = {
    {"delta", &Figures::delta},     {"gain", &Figures::gain},         {"gain_error", &Figures::gain_error},
    {"rho", &Figures::rho},         {"improved", &Figures::improved}, {"tied", &Figures::tied},
    {"quality", &Figures::quality}, {"rmse", &Figures::rmse},         {"relmse", &Figures::relmse},
    {"psnr", &Figures::psnr},       {"ssim", &Figures::ssim},         {"flip", &Figures::flip}};

nlohmann::ordered_json to_json(const ExperimentResult& result);

// One view, and back; names, camera and size come from the task. Throws nlohmann::json::exception.
nlohmann::ordered_json to_json(const std::vector<RowName>& names, const ViewResult& view);
ViewResult view_from_json(const nlohmann::ordered_json& json, const ViewTask& task);

// Numbers and flags as such, everything else as text.
nlohmann::ordered_json typed_value(const ParameterInfo& parameter);

// Parameters and their values as one object.
nlohmann::ordered_json to_json(const std::vector<ParameterInfo>& parameters);

} // namespace luxel
