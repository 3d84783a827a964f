// SPDX-License-Identifier: MIT
// luxel export: a view of a scene for another renderer.
#include <cstdio>
#include <filesystem>

#include "core/error.h"
#include "experiments/output_folder.h"
#include "experiments/view_choice.h"
#include "options.h"
#include "scene/height_field.h"
#include "scene/povray/povray.h"

namespace luxel::app {

namespace {

struct Options {
    std::string scene, output, to = "povray", size = "640x480", view = "0", cameras;
    PovraySettings settings;
};

void run(const Options& o, const Global& global) {
    const Size size = parse_size(o.size);
    if (std::filesystem::path(o.output).extension() != ".pov")
        fail(Fault::usage, "{}: output: expected a name that ends in .pov", o.output);
    check_writable(o.output);
    const Scene scene = with_height_fields(load(o.scene, global));
    const Camera camera = choose_views(scene, {.file = o.cameras, .names = {o.view}})[0];
    const std::vector<std::string> approximated =
        write_povray(o.output, scene, camera, size.width, size.height, o.settings);

    if (global.json)
        return print_json({{"scene", o.scene},
                           {"view", camera.name},
                           {"output", o.output},
                           {"approximated", approximated}});
    fmt::print("{}: '{}', {} triangles\n", o.output, camera.name, scene.triangles());
    for (const std::string& sentence : approximated) fmt::print("approximated: {}\n", sentence);
}

} // namespace

void add_export(CLI::App& app, const Global& global) {
    auto o = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand("export", "Write one view for another renderer");
    command->add_option("scene", o->scene, "builtin:NAME, .gltf, .glb, .obj or .toml")->required();
    command->add_option("-o,--output", o->output, "FILE.pov; textures are written beside it")->required();
    command->add_option("--to", o->to, "povray: POV-Ray 3.7")
        ->check(CLI::IsMember({"povray"}))
        ->capture_default_str();
    command->add_option("--view", o->view, "Camera by name or number")->capture_default_str();
    add_cameras_option(*command, o->cameras);
    command->add_option("--size", o->size, "Pixels, WIDTHxHEIGHT")->capture_default_str();
    command->add_flag("!--no-radiosity", o->settings.radiosity, "Direct light alone");
    command->add_flag("!--diffuse-only", o->settings.specular, "No mirrors, no glass");
    command->add_option("--area-lights", o->settings.area_lights, "Samples of the emissive meshes")
        ->check(CLI::Range(1, 4096))
        ->capture_default_str();
    command->add_option("--environment-lights", o->settings.environment_lights, "Samples of the environment")
        ->check(CLI::Range(1, 4096))
        ->capture_default_str();
    command->footer(
        "What POV-Ray cannot express is listed, also as comments in the file.\n"
        "Example: luxel export builtin:cornell --to povray -o box.pov && povray +Ibox.pov +FE -A");
    command->callback([o, &global] { run(*o, global); });
}

} // namespace luxel::app
