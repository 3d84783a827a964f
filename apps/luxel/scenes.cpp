// SPDX-License-Identifier: MIT
// luxel scenes: what can follow "builtin:".
#include <cstdio>

#include "options.h"
#include "scene/load.h"

namespace luxel::app {

namespace {

void run(const Global& global) {
    nlohmann::ordered_json json = {{"scenes", nlohmann::ordered_json::array()}};
    std::vector<std::vector<std::string>> lines;
    for (const BuiltinScene& scene : builtin_scenes()) {
        json["scenes"].push_back({{"source", "builtin:" + scene.name}, {"meaning", scene.meaning}});
        lines.push_back({"builtin:" + scene.name, scene.meaning});
    }
    if (global.json) return print_json(json);
    fmt::print("{}", in_columns(lines));
}

} // namespace

void add_scenes(CLI::App& app, const Global& global) {
    CLI::App* command = app.add_subcommand("scenes", "List the built-in scenes");
    command->footer("Example: luxel scenes --json");
    command->callback([&global] { run(global); });
}

} // namespace luxel::app
