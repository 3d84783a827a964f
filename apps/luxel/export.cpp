// SPDX-License-Identifier: MIT
// luxel export: a view of a scene for another renderer, or the scene as a whole.
#include <cstdio>
#include <filesystem>

#include <fmt/ranges.h>

#include "core/error.h"
#include "experiments/output_folder.h"
#include "experiments/view_choice.h"
#include "options.h"
#include "scene/export/gltf/gltf.h"
#include "scene/export/mitsuba/mitsuba.h"
#include "scene/export/pbrt/pbrt.h"
#include "scene/export/povray/povray.h"
#include "scene/height_field.h"

namespace luxel::app {

namespace {

struct Options {
    std::string scene, output, to, size = "640x480", view = "0", cameras;
    PovraySettings settings;
};

struct Format {
    std::string name, meaning;
    std::vector<std::string> endings;
    std::vector<std::string> (*write)(const Options&, const Scene&, const ExportedView&);
};

const std::vector<Format>& formats() {
    static const std::vector<Format> all = {
        {"povray",
         "POV-Ray 3.7",
         {".pov"},
         [](const Options& o, const Scene& scene, const ExportedView& v) {
             return write_povray(o.output, scene, v.camera, v.width, v.height, o.settings);
         }},
        {"pbrt",
         "pbrt-v4",
         {".pbrt"},
         [](const Options& o, const Scene& scene, const ExportedView& v) {
             return write_pbrt(o.output, scene, v);
         }},
        {"mitsuba",
         "Mitsuba 3",
         {".xml"},
         [](const Options& o, const Scene& scene, const ExportedView& v) {
             return write_mitsuba(o.output, scene, v);
         }},
        {"gltf",
         "glTF 2.0, the scene as a whole",
         {".gltf", ".glb"},
         [](const Options& o, const Scene& scene, const ExportedView& v) {
             return write_gltf(o.output, scene, v);
         }},
    };
    return all;
}

// By --to, else by the output's ending; both must agree.
const Format& format_of(const Options& o) {
    const std::string ending = std::filesystem::path(o.output).extension().string();
    std::vector<std::string> endings;
    for (const Format& format : formats()) {
        const bool ends =
            std::find(format.endings.begin(), format.endings.end(), ending) != format.endings.end();
        if (o.to.empty() ? ends : format.name == o.to && ends) return format;
        if (o.to.empty() || format.name == o.to)
            endings.insert(endings.end(), format.endings.begin(), format.endings.end());
    }
    fail(Fault::usage, "{}: output: expected a name that ends in {}", o.output, fmt::join(endings, " or "));
}

void run(const Options& o, const Global& global) {
    const Size size = parse_size(o.size);
    const Format& format = format_of(o);
    check_writable(o.output);
    const Scene scene = with_height_fields(load(o.scene, global));
    const Camera camera = choose_views(scene, {.file = o.cameras, .names = {o.view}})[0];
    const std::vector<std::string> approximated = format.write(o, scene, {camera, size.width, size.height});

    for (const std::string& sentence : approximated)
        fmt::print(stderr, "luxel: warning: approximated: {}\n", sentence);
    if (global.json)
        return print_json({{"scene", o.scene},
                           {"view", camera.name},
                           {"output", o.output},
                           {"to", format.name},
                           {"approximated", approximated}});
    fmt::print("{}: '{}', {} triangles, for {}\n", o.output, camera.name, scene.triangles(), format.meaning);
}

} // namespace

void add_export(CLI::App& app, const Global& global) {
    auto o = std::make_shared<Options>();
    CLI::App* command =
        app.add_subcommand("export", "Write one view for another renderer, or the scene as glTF");
    command->add_option("scene", o->scene, "builtin:NAME, .gltf, .glb, .obj or .toml")->required();
    std::string meanings, endings;
    std::vector<std::string> names;
    for (const Format& format : formats()) {
        names.push_back(format.name);
        meanings += (meanings.empty() ? "" : "; ") + format.name + ": " + format.meaning;
        for (const std::string& ending : format.endings) endings += (endings.empty() ? "" : ", ") + ending;
    }
    command
        ->add_option("-o,--output", o->output,
                     "FILE, " + endings + "; meshes and textures are written beside it")
        ->required();
    command->add_option("--to", o->to, meanings + "; default: by the output's ending")
        ->check(CLI::IsMember(names));
    command->add_option("--view", o->view, "Camera by name or number")->capture_default_str();
    add_cameras_option(*command, o->cameras);
    command->add_option("--size", o->size, "Pixels, WIDTHxHEIGHT")->capture_default_str();
    command->add_flag("!--no-radiosity", o->settings.radiosity, "POV-Ray: direct light alone");
    command->add_flag("!--diffuse-only", o->settings.specular, "POV-Ray: no mirrors, no glass");
    command->add_option("--area-lights", o->settings.area_lights, "POV-Ray: samples of the emissive meshes")
        ->check(CLI::Range(1, 4096))
        ->capture_default_str();
    command
        ->add_option("--environment-lights", o->settings.environment_lights,
                     "POV-Ray: samples of the environment")
        ->check(CLI::Range(1, 4096))
        ->capture_default_str();
    command->footer(
        "What the other renderer cannot express is listed, also in the file; see docs/export.md.\n"
        "Examples: luxel export builtin:cornell -o box.pbrt && pbrt box.pbrt\n"
        "          luxel export builtin:cornell --to povray -o box.pov && povray +Ibox.pov +FE -A");
    command->callback([o, &global] { run(*o, global); });
}

} // namespace luxel::app
