// SPDX-License-Identifier: MIT
// luxel reference: the truth of one view.
#include <cstdio>

#include <fmt/ranges.h>

#include "core/codec.h"
#include "core/error.h"
#include "experiments/components.h"
#include "experiments/evaluation.h"
#include "experiments/memory_budget.h"
#include "experiments/picture_settings.h"
#include "experiments/view_choice.h"
#include "options.h"
#include "reference/estimate_io.h"
#include "reference/reference.h"
#include "scene/height_field.h"

namespace luxel::app {

namespace {

struct Options {
    std::vector<std::string> components = {"full"};
    std::string scene, output, size = "640x480", view = "0", cameras, settings;
    ReferenceSettings reference;
    std::string resume, sampling = "area", frame;
    float exposure = 0;
};

// The first sum is the unnamed layer, so that any viewer shows it; every component follows with its variance
// and its groups of samples, which diff takes the noise out with.
Layers picture_layers(const Estimate& estimate, const Image& sum, std::vector<std::string>& warnings) {
    Layers layers = layers_of(estimate);
    layers[""] = sum;
    std::uint64_t bytes = 0;
    for (const auto& [name, image] : layers) bytes += image.data.size() * sizeof(float);
    if (bytes <= codec::max_decoded_bytes && estimate.spp >= sample_groups) return layers;

    // Groups without a sample say nothing, and what cannot be read again is of no use.
    for (const auto& [name, mean] : estimate.mean)
        for (int g = 0; g < sample_groups; ++g) layers.erase(group_layer(name, g));
    if (bytes > codec::max_decoded_bytes)
        warnings.push_back(
            "the file would be too large to be read again: it holds no groups of samples, so that "
            "diff cannot take "
            "the noise out");
    return layers;
}

std::string sampling_sentence(const std::string& sampling) {
    return sampling == "center" ? "at pixel centers, as frames are"
                                : "over pixel areas (frames sample pixel centers: --sampling center)";
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
    options.reference.pixel_center = options.sampling == "center";
    set_parameters(options.reference, "reference", parse_values("--settings", options.settings));
    FrameOptions frame;
    set_parameters(frame, "--frame", parse_values("--frame", options.frame));
    check_picture_output(options.output);
    ReferenceRequest request;
    for (const auto& sum : sums) request.components.insert(request.components.end(), sum.begin(), sum.end());

    require_memory(size.width, size.height, request.components.size());

    const Scene loaded = load(options.scene, global);
    const bool as_frame = !options.frame.empty();
    const Scene scene = as_frame ? reference_scene(loaded, frame, false) : with_height_fields(loaded);
    const RayCaster rays(scene);
    request.width = size.width, request.height = size.height;
    request.camera = choose_views(rays, {.file = options.cameras, .names = {options.view}})[0];
    request.settings = options.reference;
    request.error_of = sums[0];
    request.checkpoint = options.resume;
    request.quiet = global.quiet;
    const Estimate estimate = render_reference(rays, request);
    const Image sum = sum_of(estimate.mean, sums[0]);
    Attributes attributes = attributes_of(loaded, options.scene, request.camera, as_frame ? &frame : nullptr);
    add_reference(attributes, options.components[0], options.reference, estimate.spp);
    std::vector<std::string> warnings = estimate.warnings;
    const bool all_layers = options.output.ends_with(".exr");
    write_picture(options.output, all_layers ? picture_layers(estimate, sum, warnings) : Layers{}, sum,
                  estimate.mask, options.exposure, attributes);
    print_warnings(warnings);

    const std::optional<RelativeError> error = relative_error(estimate, sums[0]);
    const std::string& sampling = attributes.at(attribute::sampling);
    nlohmann::ordered_json json = {{"scene", options.scene},
                                   {"view", request.camera.name},
                                   {"size", {size.width, size.height}},
                                   {"component", options.components[0]},
                                   {"spp", estimate.spp},
                                   {"seed", options.reference.seed},
                                   {"sampling", sampling},
                                   {"relative_error", nullptr},
                                   {"output", options.output}};
    if (error) json["relative_error"] = error->value;
    const auto errors = errors_of_photons(estimate);
    for (const auto& [name, e] : errors) json[name] = {{"noise", e.noise}, {"bias", e.bias}};
    if (global.json) return print_json(json);
    fmt::print("{}: {} of '{}', {} samples a pixel {}; {}\n", options.output, fmt::join(sums[0], " + "),
               request.camera.name, estimate.spp, sampling_sentence(sampling),
               error ? fmt::format("mean relative standard error {:.2f} %", 100.0 * error->value)
                     : fmt::format("error not known below {} samples", samples_for_error));
    for (const auto& [name, e] : errors)
        fmt::print("{}: noise {:.1f} %, bias {:.1f} % of its root mean square\n", name, 100.0 * e.noise,
                   100.0 * e.bias);
}

} // namespace

void add_reference(CLI::App& app, const Global& global) {
    auto o = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand("reference", "Path trace the truth of one view on the CPU");
    command->add_option("scene", o->scene, "builtin:NAME, .gltf, .glb, .obj or .toml")->required();
    command
        ->add_option("-o,--output", o->output,
                     "FILE.exr (all components, variance, groups of samples, mask) or FILE.png")
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
        ->check(non_negative());
    command
        ->add_option("--error", o->reference.error,
                     "Stop at this mean relative standard error, at 16 samples or more; 0 = no target")
        ->check(non_negative());
    command->add_option("--seed", o->reference.seed, "Of the random numbers")
        ->check(CLI::NonNegativeNumber)
        ->capture_default_str();
    command->add_option("--resume", o->resume, "Checkpoint: continued when it is there, kept up to date");
    command
        ->add_option("--sampling", o->sampling,
                     "Where a pixel is sampled: over its area (antialiased), or at its center as frames and "
                     "evaluate's "
                     "truths are")
        ->check(CLI::IsMember({"area", "center"}))
        ->capture_default_str();
    command->add_option(
        "--frame", o->frame,
        "key=value,... as of render: light from afar as such a frame has it; default: the true environment");
    add_exposure_option(*command, o->exposure);
    std::string names;
    for (const ParameterInfo& p : parameters_of(o->reference)) names += (names.empty() ? "" : ", ") + p.name;
    command->add_option("--settings", o->settings, "key=value,... of the path tracer: " + names);
    command->footer(
        "Examples: luxel reference builtin:cornell --component direct+diffuse1 --spp 256 -o truth.exr\n"
        "          luxel reference builtin:cornell --component direct+diffuse1 --sampling center -o "
        "truth.exr\n"
        "          luxel diff truth.exr picture.exr, where luxel render wrote picture.exr");
    command->callback([o, &global] { run(*o, global); });
}

} // namespace luxel::app
