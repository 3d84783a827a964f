// SPDX-License-Identifier: MIT
// luxel techniques: what can follow --use, with every parameter.
#include <cstdio>

#include "experiments/results_json.h"
#include "options.h"
#include "techniques/frame/frame.h"
#include "techniques/technique.h"

namespace luxel::app {

namespace {

using Json = nlohmann::ordered_json;

Json describe(const std::vector<ParameterInfo>& parameters) {
    Json json = Json::array();
    for (const ParameterInfo& p : parameters)
        json.push_back({{"name", p.name},
                        {"type", p.type},
                        {"default", typed_value(p)},
                        {"allowed", p.allowed},
                        {"meaning", p.meaning}});
    return json;
}

// A heading and its parameters.
using Lines = std::vector<std::vector<std::string>>;
void add_lines(Lines& lines, const std::string& heading, const std::vector<ParameterInfo>& parameters) {
    lines.push_back({""});
    lines.push_back({heading});
    for (const ParameterInfo& p : parameters) lines.push_back({"  " + p.name, p.value, p.allowed, p.meaning});
}

void run(const Global& global) {
    Json json = {{"techniques", Json::array()}};
    Lines lines = {{"  parameter", "default", "allowed", "meaning"}};
    for (const TechniqueInfo& info : all_techniques()) {
        const std::unique_ptr<Technique> technique = info.make();
        const std::vector<ParameterInfo> parameters = parameters_of(*technique);
        json["techniques"].push_back({{"name", info.name},
                                      {"slot", slot_name(info.slot)},
                                      {"summary", info.summary},
                                      {"parameters", describe(parameters)}});
        add_lines(lines, fmt::format("{} ({}): {}", info.name, slot_name(info.slot), info.summary),
                  parameters);
    }
    FrameOptions frame;
    json["frame"] = describe(parameters_of(frame));
    add_lines(lines, "--frame: what every technique is built on", parameters_of(frame));
    if (global.json) return print_json(json);
    fmt::print("{}", in_columns(lines));
}

} // namespace

void add_techniques(CLI::App& app, const Global& global) {
    CLI::App* command =
        app.add_subcommand("techniques", "List the techniques and the frame options with all parameters");
    command->footer("Example: luxel techniques --json");
    command->callback([&global] { run(global); });
}

} // namespace luxel::app
