// SPDX-License-Identifier: MIT
// luxel reference: the truth of one view.
#include <cstdio>

#include <fmt/ranges.h>

#include "core/error.h"
#include "experiments/components.h"
#include "experiments/memory_budget.h"
#include "experiments/view_choice.h"
#include "options.h"
#include "reference/reference.h"
#include "scene/height_field.h"

namespace luxel::app {

namespace {

struct Options {
    std::vector<std::string> components = {"full"};
    std::string scene, output, size = "640x480", view = "0", cameras, settings;
    ReferenceSettings reference;
    std::string resume;
    float exposure = 0;
};

// The first sum is the unnamed layer, so that any viewer shows it; every component follows with the variance
// of its mean.
Layers layers_of(const Estimate& estimate, const Image& sum) {
    Layers layers = {{"", sum}, {"mask", estimate.mask}};
    for (const auto& [name, image] : estimate.mean) layers[name] = image;
    for (const auto& [name, image] : estimate.variance) layers["variance." + name] = image;
    return layers;
}

// Noise and bias of the components that hold photons.
std::vector<std::pair<std::string, PhotonError>> errors_of_photons(const Estimate& estimate) {
    std::vector<std::pair<std::string, PhotonError>> errors;
    for (const char* name : {"caustics", "specular", "full"}) {
        const bool alone = std::string_view(name) == "caustics";
        if (!alone && !estimate.mean.contains("photon_bias")) continue;
        const PhotonError error = photon_error(estimate, name);
        if (error.noise > 0.0) errors.emplace_back(name, error);
    }
    return errors;
}

void run(Options options, const Global& global) {
    const Size size = parse_size(options.size);
    std::vector<std::vector<std::string>> sums;
    for (const std::string& text : options.components) sums.push_back(parse_components(text));
    set_parameters(options.reference, "reference", parse_values("--settings", options.settings));
    check_picture_output(options.output);
    ReferenceRequest request;
    for (const auto& sum : sums) request.components.insert(request.components.end(), sum.begin(), sum.end());

    require_memory(size.width, size.height, request.components.size());

    const Scene scene = with_height_fields(load(options.scene, global));
    const RayCaster rays(scene);
    request.width = size.width, request.height = size.height;
    request.camera = choose_views(rays, {.file = options.cameras, .names = {options.view}})[0];
    request.settings = options.reference;
    request.checkpoint = options.resume;
    request.quiet = global.quiet;
    const Estimate estimate = render_reference(rays, request);
    print_warnings(estimate.warnings);

    const Image sum = sum_of(estimate.mean, sums[0]);
    write_picture(options.output, layers_of(estimate, sum), sum, estimate.mask, options.exposure,
                  {{"luxel.version", LUXEL_VERSION},
                   {"luxel.scene", options.scene},
                   {"luxel.view", request.camera.name},
                   {"luxel.component", options.components[0]},
                   {"luxel.spp", fmt::format("{}", estimate.spp)},
                   {"luxel.seed", fmt::format("{}", options.reference.seed)}});

    nlohmann::ordered_json json = {{"scene", options.scene},
                                   {"view", request.camera.name},
                                   {"size", {size.width, size.height}},
                                   {"spp", estimate.spp},
                                   {"relative_error", relative_error(estimate) ? relative_error(estimate)->value : 0.0},
                                   {"output", options.output}};
    const auto errors = errors_of_photons(estimate);
    for (const auto& [name, e] : errors) json[name] = {{"noise", e.noise}, {"bias", e.bias}};
    if (global.json) return print_json(json);
    fmt::print("{}: {} of '{}', {} samples a pixel\n", options.output, fmt::join(sums[0], " + "),
               request.camera.name, estimate.spp);
    for (const auto& [name, e] : errors)
        fmt::print("{}: noise {:.1f} %, bias {:.1f} % of its root mean square\n", name, 100.0 * e.noise,
                   100.0 * e.bias);
}

} // namespace

void add_reference(CLI::App& app, const Global& global) {
    auto o = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand("reference", "Path trace the truth of one view on the CPU");
    command->add_option("scene", o->scene, "builtin:NAME, .gltf, .glb, .obj or .toml")->required();
    command->add_option("-o,--output", o->output, "FILE.exr (all components, variance, mask) or FILE.png")
        ->required();
    command
        ->add_option("--component", o->components,
                     "Light paths, may be a sum: " + fmt::format("{}", fmt::join(component_names, ", ")) +
                         "; may be repeated: the first is shown, all are stored in .exr")
        ->allow_extra_args(false)
        ->capture_default_str();
    command->add_option("--view", o->view, "Camera by name or number")->capture_default_str();
    add_cameras_option(*command, o->cameras);
    command->add_option("--size", o->size, "Pixels, WIDTHxHEIGHT")->capture_default_str();
    command->add_option("--spp", o->reference.spp, "Samples a pixel, at most")
        ->check(CLI::Range(1, 1 << 20))
        ->capture_default_str();
    command->add_option("--seconds", o->reference.seconds, "Stop after this time; 0 = no limit")
        ->check(CLI::NonNegativeNumber);
    command
        ->add_option("--error", o->reference.error,
                     "Stop at this mean relative standard error; 0 = no target")
        ->check(CLI::NonNegativeNumber);
    command->add_option("--seed", o->reference.seed, "Of the random numbers")
        ->check(CLI::NonNegativeNumber)
        ->capture_default_str();
    command->add_option("--resume", o->resume, "Checkpoint: continued when it is there, kept up to date");
    command->add_option("--exposure", o->exposure, "For .png; 0 = 98th percentile to white")
        ->check(CLI::NonNegativeNumber);
    std::string names;
    for (const ParameterInfo& p : parameters_of(o->reference)) names += (names.empty() ? "" : ", ") + p.name;
    command->add_option("--settings", o->settings, "key=value,... of the path tracer: " + names);
    command->footer(
        "Example: luxel reference builtin:cornell --component direct+diffuse1 --spp 256 -o truth.exr");
    command->callback([o, &global] { run(*o, global); });
}

} // namespace luxel::app
