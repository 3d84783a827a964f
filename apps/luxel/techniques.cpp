// SPDX-License-Identifier: MIT
// luxel techniques: what can follow --use, with every parameter.
#include <cstdio>

#include <fmt/ranges.h>

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
                        {"only_with", p.when},
                        {"meaning", p.meaning}});
    return json;
}

// A heading and its parameters.
using Lines = std::vector<std::vector<std::string>>;
void add_lines(Lines& lines, const std::string& heading, const std::vector<ParameterInfo>& parameters) {
    lines.push_back({""});
    lines.push_back({heading});
    for (const ParameterInfo& p : parameters)
        lines.push_back({"  " + p.name, p.value, p.allowed,
                         p.when.empty() ? p.meaning : fmt::format("{} (with {})", p.meaning, p.when)});
}

// By its defaults. An empty scene meets no need, so that all are listed.
Json describe(const TechniqueInfo& info, Lines& lines) {
    const std::unique_ptr<Technique> technique = info.make();
    const std::vector<ParameterInfo> parameters = parameters_of(*technique);
    Json needs = Json::array();
    for (const Need& need : technique->needs(Scene{}, {})) needs.push_back(need.what);
    add_lines(lines, fmt::format("{} ({}): {}", info.name, slot_name(info.slot), info.summary), parameters);
    lines.push_back({fmt::format("  computes {}", fmt::join(technique->components(), " and "))});
    for (const Json& need : needs) lines.push_back({fmt::format("  needs {}", need.get<std::string>())});
    return {{"name", info.name},       {"slot", slot_name(info.slot)},
            {"summary", info.summary}, {"components", technique->components()},
            {"needs", needs},          {"parameters", describe(parameters)}};
}

void run(const std::string& name, const Global& global) {
    if (!name.empty()) make_technique({name, {}}); // an unknown one is answered with those that there are
    Json json = {{"techniques", Json::array()}};
    Lines lines = {{"  parameter", "default", "allowed", "meaning"}};
    for (const TechniqueInfo& info : all_techniques())
        if (name.empty() || name == info.name) json["techniques"].push_back(describe(info, lines));
    if (name.empty()) {
        FrameOptions frame;
        json["frame"] = describe(parameters_of(frame));
        add_lines(lines, "--frame: what every technique is built on", parameters_of(frame));
    }
    if (global.json) return print_json(json);
    fmt::print("{}", in_columns(lines));
}

} // namespace

void add_techniques(CLI::App& app, const Global& global) {
    CLI::App* command =
        app.add_subcommand("techniques", "List the techniques and the frame options with all parameters");
    auto name = std::make_shared<std::string>();
    command->add_option("name", *name, "Only this technique");
    command->footer("Examples: luxel techniques --json\n"
                    "          luxel techniques isr");
    command->callback([name, &global] { run(*name, global); });
}

} // namespace luxel::app
