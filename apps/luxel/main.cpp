// SPDX-License-Identifier: MIT
// luxel: the command line. Exit codes are those of core/error.h, one sentence on stderr says why.
#include <cstdio>
#include <filesystem>
#include <new>
#include <optional>

#include <fmt/format.h>
#include <tbb/global_control.h>

#include "commands.h"
#include "core/error.h"
#include "core/interrupt.h"
#include "help.h"
#include "scene/load.h"

namespace {

using luxel::Fault, luxel::light_units_names, luxel::single_sided_names;

int report(Fault fault, const std::string& sentence) {
    std::fflush(stdout);
    fmt::print(stderr, "luxel: {}\n", sentence);
    return static_cast<int>(fault);
}

constexpr const char* footer =
    R"(Exit codes: 0 done, 2 wrong usage, 3 not possible on this machine, 4 bad input, 5 out of
memory or another resource, 6 cannot read or write, 7 the device was lost.

Examples:
  luxel evaluate builtin:cornell --use isr -o out
  luxel experiment experiments/quick.toml -o out
  luxel render scene.gltf --use isr:samples=80 -o picture.png
  luxel reference scene.gltf --component diffuse --spp 256 -o truth.exr
Each subcommand has its own --help.)";

int run(int argc, char** argv) {
    luxel::app::Global global;
    CLI::App app(
        "Which global-illumination technique should a scene use, what does it cost, how wrong is it?",
        "luxel");
    app.set_version_flag("--version", "luxel " LUXEL_VERSION);
    app.require_subcommand(1);
    app.fallthrough();
    app.footer(footer);
    app.formatter(luxel::app::make_formatter());
    app.add_flag("--strict", global.strict, "A substitute (a missing texture) is an error, not a warning");
    app.add_flag("--quiet", global.quiet, "No progress on stderr");
    app.add_flag("--json", global.json, "Print figures as JSON");

    app.add_option("--environment", global.environment,
                   "Light from a sky instead of the scene's own: 'sky', or an equirectangular .hdr or .exr");
    app.add_option("--environment-scale", global.environment_scale, "Factor on --environment")
        ->check(CLI::Range(0.0, 1e6));

    app.add_option("--single-sided", global.single_sided,
                   "Backs of single-sided surfaces: cameras look through them (cull), or not (opaque)")
        ->check(CLI::IsMember(single_sided_names))
        ->capture_default_str();
    app.add_option(
           "--lights", global.lights,
           "Intensities of punctual lights in glTF files: candela and lux (photometric), the same made\n"
           "of watts by 683 lm/W (watts), or watts of the whole lamp (power)")
        ->check(CLI::IsMember(light_units_names))
        ->capture_default_str();

    app.add_option("--data", global.data,
                   "Folder of what scene files and experiments call data:...; default: $LUXEL_DATA")
        ->envname("LUXEL_DATA");

    app.add_option_function<std::string>(
           "--brdf", [&](const std::string& model) { global.single_scattering = model == "single"; },
           "How rough lobes keep their energy: 'multiple' scattering between facets, or 'single' as before")
        ->check(CLI::IsMember({"multiple", "single"}));

    // The limit lives as long as the work does.
    std::optional<tbb::global_control> limit;
    app.add_option("--threads", global.threads, "CPU threads; 0 = all")->check(CLI::Range(0, 1024));
    app.parse_complete_callback([&] {
        if (global.threads > 0)
            limit.emplace(tbb::global_control::max_allowed_parallelism, std::size_t(global.threads));
    });

    using namespace luxel::app;
    for (auto add : {add_evaluate, add_experiment, add_render, add_reference, add_diff, add_techniques,
                     add_scenes, add_info, add_views, add_export, add_reproduce, add_cache, add_devices})
        add(app, global);
    require_known_subcommand(app, argc, argv);
    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& done) { // --help, --version
        return app.exit(done);
    } catch (const CLI::ParseError& e) {
        return report(Fault::usage, sentence_of(app, e));
    }
    return 0;
}

} // namespace

int main(int argc, char** argv) {
    try {
        return run(argc, argv);
    } catch (const luxel::Error& e) {
        return report(e.fault(), e.what());
    } catch (const luxel::Interrupted& stop) {
        return report(static_cast<Fault>(128 + stop.signal), "stopped; the same command goes on from here");
    } catch (const std::bad_alloc&) {
        return report(Fault::resource, "memory: not enough for this run");
    } catch (const std::filesystem::filesystem_error& e) {
        return report(Fault::io, e.what());
    }
}
