// SPDX-License-Identifier: MIT
// luxel evaluate: truth and techniques for every view, as table, results.json and report.html.
#include <cstdio>

#include <fmt/ranges.h>

#include "core/error.h"
#include "core/interrupt.h"
#include "experiments/components.h"
#include "experiments/experiment_run.h"
#include "experiments/output_folder.h"
#include "experiments/result_files.h"
#include "experiments/results_json.h"
#include "experiments/table.h"
#include "options.h"

namespace luxel::app {

namespace {

constexpr int page_width = 1280; // pixels; one scene's pictures may be large

struct Options {
    std::string scene;
    ViewGroup views;
    TruthSettings truth;
    std::vector<std::string> use, images;
    std::string component = "direct+diffuse1", size = "640x480", frame, reference_lights = "same", output,
                device, ao_radius, ao_membership;
    CacheChoice cache;
    int timed_frames = 5;
    bool verbose = false;
};

// --ao-radius and --ao-membership are parameters of the reference, with its ranges and names.
void set_ao(TruthSettings& truth, const Options& o) {
    std::vector<std::pair<std::string, std::string>> values;
    if (!o.ao_radius.empty()) values.emplace_back("ao_radius", o.ao_radius);
    if (!o.ao_membership.empty()) values.emplace_back("ao_membership", o.ao_membership);
    if (!values.empty() && !is_accessibility(truth.components))
        fail(Fault::usage, "--ao-radius, --ao-membership: only --component ao has them");
    ReferenceSettings reference;
    set_parameters(reference, "--component ao", values);
    truth.ao_radius = reference.ao_radius;
    truth.ao_membership = reference.ao_membership;
}

// An experiment with one scene.
Experiment experiment_of(const Options& o, const Global& global) {
    Experiment e;
    e.name = o.scene;
    e.uses = o.use;
    for (const std::string& image : o.images) e.uses.push_back("image:" + image);
    e.timed_frames = o.timed_frames;
    e.pictures = PictureMode::files;
    e.picture_width = page_width;
    e.truth = o.truth;
    e.truth.components = parse_components(o.component);
    e.truth.true_environment = o.reference_lights == "true";
    set_ao(e.truth, o);

    SceneEntry scene;
    scene.name = scene.group = scene.source = scene.file = o.scene;
    scene.load = load_options(global);
    const auto frame = parse_values("--frame", o.frame);
    set_parameters(scene.frame, "--frame", frame);
    scene.warnings = idle_parameters(scene.frame, "--frame", frame);
    ViewGroup views = o.views;
    views.choice.seed = std::uint32_t(o.truth.seed);
    const Size size = parse_size(o.size);
    views.width = size.width, views.height = size.height;
    scene.views = {views};
    e.scenes = {scene};
    return e;
}

void run(const Options& o, const Global& global) {
    const Experiment experiment = experiment_of(o, global);
    const PictureFiles pictures(o.output, experiment);
    OutputFolder output(o.output);
    const InterruptScope interrupt;
    const ExperimentResult result = run_experiment(
        experiment, {.device = o.device,
                     .cache = o.cache.path(),
                     .journal = output.path() / journal_folder,
                     .quiet = global.quiet,
                     .stop = [&] { return interrupt.signal() != 0; },
                     .warn = print_warnings,
                     .pictures = [&](const SceneEntry& scene,
                                     const ViewPictures& view) { return pictures.add(scene, view); }});
    finish_run(output, result, o.verbose, global);
    if (result.interrupted) throw Interrupted{interrupt.signal()};
}

std::string ao_memberships() {
    ReferenceSettings reference;
    for (const ParameterInfo& p : parameters_of(reference))
        if (p.name == "ao_membership") return p.allowed + " (default " + p.value + ")";
    return {};
}

void add_measurement_options(CLI::App& command, Options& o) {
    command
        .add_option("--component", o.component,
                    "Light paths of the truth, may be a sum: " +
                        fmt::format("{}", fmt::join(component_names, ", ")))
        ->capture_default_str();
    command.add_option("--ao-radius", o.ao_radius,
                       "Of --component ao, meters (default 1); give the rows the same");
    command.add_option("--ao-membership", o.ao_membership,
                       "Of --component ao: an occluder's weight by distance: " + ao_memberships());
    command.add_option("--spp", o.truth.spp, "Samples a pixel of the truth")
        ->check(CLI::Range(4, 1 << 20))
        ->capture_default_str();
    command.add_option("--seed", o.truth.seed, "Of drawn views and of the truth")
        ->check(CLI::NonNegativeNumber)
        ->capture_default_str();
    command
        .add_option(
            "--reference-lights", o.reference_lights,
            "With environment=lights: the truth has the same directional lights, or the true environment")
        ->check(CLI::IsMember({"same", "true"}))
        ->capture_default_str();
    command.add_option("--frames", o.timed_frames, "Timed frames, of which the median counts")
        ->check(CLI::Range(5, 10000))
        ->capture_default_str();
    add_cache_options(command, o.cache);
}

} // namespace

void add_evaluate(CLI::App& app, const Global& global) {
    auto o = std::make_shared<Options>();
    CLI::App* command =
        app.add_subcommand("evaluate", "Measure techniques against the truth: error, time, memory");
    command->add_option("scene", o->scene, "builtin:NAME, .gltf, .glb, .obj or .toml")->required();
    command
        ->add_option("-o,--output", o->output,
                     "Folder for report.html, results.json, results.csv and images/")
        ->required();
    command
        ->add_option(
            "--use", o->use,
            "T[:key=value,...], a row; slots joined by +; may be repeated; all: every technique that can "
            "act")
        ->allow_extra_args(false);
    command
        ->add_option("--image", o->images,
                     "NAME=FILE, a row: another renderer's picture of the view, radiance as .exr or .hdr; "
                     "{view} in FILE is a view's name; may be repeated")
        ->allow_extra_args(false);
    command
        ->add_option("--views", o->views.choice.drawn,
                     "Draw this many views by seed; default: the scene's cameras")
        ->check(CLI::Range(1, 10000));
    command->add_option("--view", o->views.choice.names, "Only this view, by name or number; may be repeated")
        ->allow_extra_args(false);
    add_cameras_option(*command, o->views.choice.file)->excludes("--views");
    command->add_option("--size", o->size, "Pixels, WIDTHxHEIGHT")->capture_default_str();
    command->add_option("--frame", o->frame, "key=value,... of the frame; see luxel techniques");
    command->add_option("--device", o->device, "GPU by number or part of its name; see luxel devices");
    command->add_flag("--verbose", o->verbose, "Print every view and the time by pass");
    add_measurement_options(*command, *o);
    command->footer(
        "Every view is kept under DIR/views when it is measured, and a truth from its first seconds on: "
        "stopped\n"
        "at any moment, the same command goes on. Ctrl-C leaves a partial report.\n"
        "Direct light alone is always the first row. The truth is path traced at pixel centers, where the\n"
        "frame samples, and stored by its content for the next run. What the truth's noise\n"
        "adds to errors is taken out; a gain that noise could explain is marked ~.\n"
        "--component ao measures the accessibility that rows multiply ambient light by, not light: its\n"
        "figures are of linear values in [0, 1], and the first row is open everywhere.\n"
        "Examples:\n"
        "  luxel evaluate builtin:cornell --use isr -o out\n"
        "  luxel evaluate sponza.gltf --use isr --use isr:mode=thesis --views 8 --size 1024x768 -o out\n"
        "  luxel evaluate builtin:cornell --component ao --ao-radius 0.3 --use isr:ao_radius=0.3 -o out\n"
        "  luxel evaluate room.gltf --use isr --image pbrt=renders/{view}.exr -o out; see luxel export\n"
        "  luxel evaluate room.toml --use isr --frame environment=lights,environment_lights=32 -o out");
    command->callback([o, &global] { run(*o, global); });
}

} // namespace luxel::app
