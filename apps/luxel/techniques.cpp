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

void print(const std::vector<ParameterInfo>& parameters) {
    for (const ParameterInfo& p : parameters)
        fmt::print("  {:<22}{} (default {}{}{})\n", p.name, p.meaning, p.value, p.allowed.empty() ? "" : "; ",
                   p.allowed);
}

void run(const Global& global) {
    Json json = {{"techniques", Json::array()}};
    for (const TechniqueInfo& info : all_techniques()) {
        const std::unique_ptr<Technique> technique = info.make();
        const std::vector<ParameterInfo> parameters = parameters_of(*technique);
        json["techniques"].push_back({{"name", info.name},
                                      {"slot", slot_name(info.slot)},
                                      {"summary", info.summary},
                                      {"parameters", describe(parameters)}});
        if (global.json) continue;
        fmt::print("{} ({}): {}\n", info.name, slot_name(info.slot), info.summary);
        print(parameters);
    }
    FrameOptions frame;
    json["frame"] = describe(parameters_of(frame));
    if (global.json) return print_json(json);
    fmt::print("--frame: what every technique is built on\n");
    print(parameters_of(frame));
}

} // namespace

void add_techniques(CLI::App& app, const Global& global) {
    CLI::App* command =
        app.add_subcommand("techniques", "List the techniques and the frame options with all parameters");
    command->footer("Example: luxel techniques --json");
    command->callback([&global] { run(global); });
}

} // namespace luxel::app
