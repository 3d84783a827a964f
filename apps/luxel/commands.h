// SPDX-License-Identifier: MIT
// One function per subcommand; each adds itself to the command line and runs from CLI11's callback.
#pragma once
#include <memory>

#include <CLI/CLI.hpp>

namespace luxel::app {

// Options that every subcommand takes.
struct Global {
    bool strict = false, quiet = false, json = false;
    int threads = 0;         // of the CPU; 0 = all
    std::string environment; // see LoadOptions
    float environment_scale = 1.0f;
    std::string data;                                          // folder of what files call "data:PATH"
    bool single_scattering = false;                            // BrdfModel::single
    std::string single_sided = "cull", lights = "photometric"; // see LoadOptions
};

void add_evaluate(CLI::App& app, const Global& global);
void add_experiment(CLI::App& app, const Global& global);
void add_render(CLI::App& app, const Global& global);
void add_reference(CLI::App& app, const Global& global);
void add_diff(CLI::App& app, const Global& global);
void add_techniques(CLI::App& app, const Global& global);
void add_scenes(CLI::App& app, const Global& global);
void add_info(CLI::App& app, const Global& global);
void add_views(CLI::App& app, const Global& global);
void add_export(CLI::App& app, const Global& global);
void add_reproduce(CLI::App& app, const Global& global);
void add_cache(CLI::App& app, const Global& global);
void add_devices(CLI::App& app, const Global& global);

} // namespace luxel::app
