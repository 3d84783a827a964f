// SPDX-License-Identifier: MIT
// luxel views: cameras drawn by seed, as a script for the other subcommands.
#include <cstdio>
#include <filesystem>

#include "core/file.h"
#include "experiments/output_folder.h"
#include "options.h"
#include "scene/camera_file.h"
#include "scene/views.h"

namespace luxel::app {

namespace {

struct Options {
    std::string scene, output;
    int count = 8, seed = 1;
};

void run(const Options& o, const Global& global) {
    if (!o.output.empty()) check_writable(o.output);
    const Scene scene = load(o.scene, global);
    const RayCaster rays(scene);
    const std::vector<Camera> cameras = draw_views(scene, rays, o.count, std::uint32_t(o.seed));
    const std::string text = camera_file_text(
        cameras, fmt::format("{} views of {}, drawn with seed {}", o.count, o.scene, o.seed), scene.origin);

    if (o.output.empty()) {
        fmt::print("{}", text);
        return;
    }
    write_file(o.output, text);
    if (global.json) return print_json({{"scene", o.scene}, {"output", o.output}, {"views", cameras.size()}});
    fmt::print("{}: {} views\n", o.output, cameras.size());
}

} // namespace

void add_views(CLI::App& app, const Global& global) {
    auto o = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand("views", "Draw cameras by seed and write them as a script");
    command->add_option("scene", o->scene, "builtin:NAME, .gltf, .glb, .obj or .toml")->required();
    command->add_option("-o,--output", o->output, "FILE.toml for --cameras; default: printed");
    command->add_option("--count", o->count, "How many")->check(CLI::Range(1, 1000))->capture_default_str();
    command->add_option("--seed", o->seed, "Of the random numbers")
        ->check(CLI::NonNegativeNumber)
        ->capture_default_str();
    command->footer(
        "A view sees geometry in most of its pixels, is level, not inside a wall, not filled by one\n"
        "and not without light. The first N views of a seed are the same for every --count.\n"
        "Example: luxel views scene.gltf --count 12 --seed 3 -o views.toml\n"
        "         luxel evaluate scene.gltf --cameras views.toml --use isr -o out");
    command->callback([o, &global] { run(*o, global); });
}

} // namespace luxel::app
