// SPDX-License-Identifier: MIT
// luxel render: one view in real time.
#include <cstdio>

#include <fmt/ranges.h>

#include "core/error.h"
#include "experiments/memory_budget.h"
#include "experiments/picture_settings.h"
#include "experiments/technique_rows.h"
#include "experiments/timing.h"
#include "experiments/view_choice.h"
#include "options.h"
#include "techniques/frame/renderer.h"

namespace luxel::app {

namespace {

constexpr int warm_up_frames = 2;

struct Options {
    std::string scene, output, use, size = "640x480", view = "0", cameras, frame, device;
    std::vector<std::string> images;
    float exposure = 0;
    int frames = 1;
};

TechniqueRow row_of(const Options& o) {
    return o.use.empty() || o.use == baseline_name ? baseline_row() : parse_use(o.use);
}

struct Rendered {
    RenderResult last;
    FrameTime time;
    gpu::DeviceInfo device;
    Camera camera;
};

Rendered render(const Scene& scene, const Options& o, const FrameOptions& frame, TechniqueRow& row) {
    const Size size = parse_size(o.size);
    gpu::Gpu gpu({.device = o.device});
    Rendered out{.device = gpu.device()};
    Renderer renderer(gpu, scene, frame);
    out.camera = choose_views(scene, {.file = o.cameras, .names = {o.view}})[0];
    const auto request_of = [&](const TechniqueRow& of) {
        RenderRequest request;
        request.camera = out.camera;
        request.width = size.width, request.height = size.height;
        for (const auto& technique : of.techniques) request.techniques.push_back(technique.get());
        request.images = o.images;
        return request;
    };
    // Pipelines compile at their first use; what techniques remember of it is thrown away with their row.
    if (o.frames > 1) {
        const TechniqueRow first = row_of(o);
        for (int i = 0; i < warm_up_frames; ++i) renderer.render(request_of(first));
    }
    const RenderRequest request = request_of(row);
    std::vector<std::vector<gpu::PassTime>> times;
    for (int i = 0; i < o.frames; ++i) {
        out.last = renderer.render(request);
        times.push_back(out.last.passes);
    }
    out.time = median_time(times);
    return out;
}

std::string time_sentence(const FrameTime& time, int frames) {
    if (frames == 1)
        return fmt::format(
            "{:.2f} ms of GPU time for a first frame, which may hold compiling (--frames 5 measures)",
            time.ms);
    return fmt::format("{:.2f} ms of GPU time, median of {} frames after warm-up ({:.2f} to {:.2f})", time.ms,
                       frames, time.least, time.most);
}

// PNG and EXR have no images of two channels: those are red and green.
Image colored(const Image& image) {
    if (image.channels != 2) return image;
    Image out(image.width, image.height, 3);
    for (int y = 0; y < out.height; ++y)
        for (int x = 0; x < out.width; ++x) out.set_rgb(x, y, {image.at(x, y)[0], image.at(x, y)[1], 0.0f});
    return out;
}

void write(const Options& o, const RenderResult& result, const std::map<std::string, std::string>& metadata) {
    Layers layers;
    for (const std::string& name : o.images)
        layers[o.images.size() > 1 ? name : ""] = colored(result.images.at(name));
    if (layers.empty()) layers[""] = result.radiance;
    const auto& [first_name, picture] = *layers.begin();
    for (const auto& [name, image] : layers)
        if (image.width != picture.width || image.height != picture.height)
            fail(Fault::usage, "--image {}: it is {}x{} where {} is {}x{}; write it to a file of its own",
                 name, image.width, image.height, first_name, picture.width, picture.height);
    // Images of another size than the frame's have no mask.
    const bool masked = picture.width == result.mask.width && picture.height == result.mask.height;
    const Image mask = masked ? result.mask : Image(picture.width, picture.height, 1, 1.0f);
    const Image shown = picture;
    layers["mask"] = mask;
    write_picture(o.output, layers, shown, mask, o.exposure, metadata);
}

void run(const Options& o, const Global& global) {
    const Size size = parse_size(o.size);
    require_memory(size.width, size.height, 0);
    TechniqueRow row = row_of(o);
    FrameOptions frame;
    set_parameters(frame, "--frame", parse_values("--frame", o.frame));
    check_picture_output(o.output);
    if (o.images.size() > 1 && !o.output.ends_with(".exr"))
        fail(Fault::usage, "{}: several --image are layers of one file, which .exr alone can hold", o.output);

    const Scene scene = load(o.scene, global);
    const Rendered rendered = render(scene, o, frame, row);
    const RenderResult& result = rendered.last;
    print_warnings(result.warnings);
    Attributes attributes = attributes_of(scene, o.scene, rendered.camera, &frame);
    add_frame(attributes, row.label, frame);
    if (!o.images.empty()) attributes["luxel.image"] = fmt::format("{}", fmt::join(o.images, ", "));
    write(o, result, attributes);

    const FrameTime& time = rendered.time;
    nlohmann::ordered_json json = {{"scene", o.scene},
                                   {"view", rendered.camera.name},
                                   {"use", row.label},
                                   {"output", o.output},
                                   {"sampling", attributes.at(attribute::sampling)},
                                   {"device", rendered.device.name},
                                   {"clock", "gpu"},
                                   {"frames", o.frames},
                                   {"warm", o.frames > 1},
                                   {"ms", time.ms},
                                   {"ms_least", time.least},
                                   {"ms_most", time.most},
                                   {"memory_bytes", result.memory_bytes}};
    json["passes"] = nlohmann::ordered_json::array();
    for (const gpu::PassTime& pass : time.passes)
        json["passes"].push_back({{"name", pass.name}, {"ms", pass.ms}});
    if (global.json) return print_json(json);
    fmt::print("{}: {} on {}, {}\n", o.output, row.label, rendered.device.name,
               time_sentence(time, o.frames));
}

} // namespace

void add_render(CLI::App& app, const Global& global) {
    auto o = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand("render", "Light one view on the GPU");
    command->add_option("scene", o->scene, "builtin:NAME, .gltf, .glb, .obj or .toml")->required();
    command->add_option("-o,--output", o->output, "FILE.png or FILE.exr (radiance)")->required();
    command->add_option("--use", o->use,
                        "T[:key=value,...], several slots joined by +; default: direct light alone");
    command->add_option("--view", o->view, "Camera by name or number")->capture_default_str();
    add_cameras_option(*command, o->cameras);
    command->add_option("--size", o->size, "Pixels, WIDTHxHEIGHT")->capture_default_str();
    command->add_option("--frame", o->frame, "key=value,... of the frame; see luxel techniques");
    command->add_option("--device", o->device, "GPU by number or part of its name; see luxel devices");
    command
        ->add_option("--image", o->images,
                     "Write this intermediate image instead, e.g. depth, normal, 'photon flux:mip=2'; may be "
                     "repeated for layers of an .exr")
        ->allow_extra_args(false);
    add_exposure_option(*command, o->exposure);
    command
        ->add_option(
            "--frames", o->frames,
            "Timed frames, of which the median counts and the last is written; above 1 after warm-up")
        ->check(CLI::Range(1, 10000))
        ->capture_default_str();
    command->footer("Cubes and layers of an image are unrolled; NAME:layer=2 or NAME:mip=1 is one of them.\n"
                    "An unknown name is answered by the list of all.\n"
                    "Examples: luxel render builtin:cornell --use isr:samples=80 -o picture.png\n"
                    "          luxel render builtin:cornell --image depth --image normal -o surfaces.exr");
    command->callback([o, &global] { run(*o, global); });
}

} // namespace luxel::app
