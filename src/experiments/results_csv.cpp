// SPDX-License-Identifier: MIT
#include "experiments/results_csv.h"

#include <algorithm>

#include <fmt/format.h>

#include "experiments/results_json.h"

namespace luxel {

namespace {

// RFC 4180: quotes around what could be taken for a border, quotes inside doubled.
std::string cell(const std::string& text) {
    if (text.find_first_of(",\"\r\n") == text.npos) return text;
    std::string quoted = "\"";
    for (char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    return quoted + "\"";
}

// Parameters are told apart by technique: "isr.samples", also where the row is one technique alone.
std::string parameter_column(const RowName& row, const ParameterInfo& parameter) {
    return parameter.name.find('.') == std::string::npos ? row.name + "." + parameter.name : parameter.name;
}

// Every parameter of every row, in order of appearance.
std::vector<std::string> parameter_columns(const std::vector<RowName>& rows) {
    std::vector<std::string> columns;
    for (const RowName& row : rows)
        for (const ParameterInfo& p : row.parameters) {
            const std::string column = parameter_column(row, p);
            if (std::find(columns.begin(), columns.end(), column) == columns.end()) columns.push_back(column);
        }
    return columns;
}

// Empty where the row has no such parameter.
std::string value_of(const RowName& row, const std::string& column) {
    for (const ParameterInfo& p : row.parameters)
        if (parameter_column(row, p) == column) return p.value;
    return {};
}

std::string line_of(const SceneEntry& scene, const ViewResult& view, const RowName& name,
                    const RowResult& row, const std::vector<std::string>& parameters) {
    std::string line =
        fmt::format("{},{},{},{},{},{},{}", cell(scene.name), cell(scene.group), cell(view.camera.name),
                    view.width, view.height, cell(name.label), cell(name.name));
    for (const std::string& column : parameters) line += "," + cell(value_of(name, column));
    for (const FigureColumn& column : figure_columns) line += fmt::format(",{}", row.figures.*column.member);
    line += fmt::format(",{}", int(row.claimed));
    if (row.own)
        line += fmt::format(",{},{},{},{},{}", row.own->component, row.own->figures.delta,
                            row.own->figures.gain, row.own->figures.gain_error, int(row.own->claimed));
    else
        line += ",,,,,";
    const RowCost& cost = row.cost;
    line += fmt::format(",{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", cell(row.unmeasured),
                        row.memory_bytes, view.reference_spp, view.noise, view.exposure, row.ms, cost.base.ms,
                        cost.base.low, cost.base.high, cost.technique.ms, cost.technique.low,
                        cost.technique.high, cost.preparation, view.reference_seconds);
    return line;
}

} // namespace

std::string results_csv(const ExperimentResult& result) {
    const std::vector<std::string> parameters = parameter_columns(result.rows);
    std::string text = "scene,group,view,width,height,label,technique";
    for (const std::string& column : parameters) text += "," + cell(column);
    for (const FigureColumn& column : figure_columns) text += fmt::format(",{}", column.name);
    text += ",claimed,own_component,own_delta,own_gain,own_gain_error,own_claimed,unmeasured,memory_bytes,"
            "reference_spp,reference_noise,exposure,ms,base_ms,base_low,base_high,technique_ms,technique_low,"
            "technique_high,preparation_seconds,reference_seconds\n";
    for (std::size_t s = 0; s < result.scenes.size(); ++s)
        for (const ViewResult& view : result.scenes[s].views)
            for (std::size_t row = 0; row < view.rows.size(); ++row)
                text +=
                    line_of(result.experiment.scenes[s], view, result.rows[row], view.rows[row], parameters);
    return text;
}

} // namespace luxel
