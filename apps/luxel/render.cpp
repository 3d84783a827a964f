// SPDX-License-Identifier: MIT
// luxel render: one view in real time.
#include <cstdio>

#include "core/error.h"
#include "experiments/memory_budget.h"
#include "experiments/technique_rows.h"
#include "experiments/timing.h"
#include "experiments/view_choice.h"
#include "options.h"
#include "techniques/frame/renderer.h"

namespace luxel::app {

namespace {

struct Options {
    std::string scene, output, use, size = "640x480", view = "0", cameras, frame, device, image;
    float exposure = 0;
};

RenderResult render(const Scene& scene, const Options& o, const FrameOptions& frame, TechniqueRow& row,
                    gpu::DeviceInfo& device) {
    const Size size = parse_size(o.size);
    gpu::Gpu gpu({.device = o.device});
    device = gpu.device();
    Renderer renderer(gpu, scene, frame);
    RenderRequest request;
    request.camera = choose_views(scene, {.file = o.cameras, .names = {o.view}})[0];
    request.width = size.width, request.height = size.height;
    for (const auto& technique : row.techniques) request.techniques.push_back(technique.get());
    if (!o.image.empty()) request.images = {o.image};
    return renderer.render(request);
}

void run(const Options& o, const Global& global) {
    const Size size = parse_size(o.size);
    require_memory(size.width, size.height, 0);
    TechniqueRow row = o.use.empty() || o.use == baseline_name ? baseline_row() : parse_use(o.use);
    FrameOptions frame;
    set_parameters(frame, "--frame", parse_values("--frame", o.frame));
    check_picture_output(o.output);

    const Scene scene = load(o.scene, global);
    gpu::DeviceInfo device;
    const RenderResult result = render(scene, o, frame, row, device);
    const Image& picture = o.image.empty() ? result.radiance : result.images.at(o.image);
    // Images of another size than the frame's have no mask.
    const bool masked = picture.width == result.mask.width && picture.height == result.mask.height;
    const Image mask = masked ? result.mask : Image(picture.width, picture.height, 1, 1.0f);
    write_picture(o.output, {{"", picture}, {"mask", mask}}, picture, mask, o.exposure,
                  {{"luxel.version", LUXEL_VERSION}, {"luxel.scene", o.scene}, {"luxel.use", row.label}});

    const FrameTime time = median_time({result.passes});
    nlohmann::ordered_json json = {{"scene", o.scene},   {"use", row.label},
                                   {"output", o.output}, {"device", device.name},
                                   {"ms", time.ms},      {"memory_bytes", result.memory_bytes}};
    json["passes"] = nlohmann::ordered_json::array();
    for (const gpu::PassTime& pass : time.passes)
        json["passes"].push_back({{"name", pass.name}, {"ms", pass.ms}});
    if (global.json) return print_json(json);
    fmt::print("{}: {} on {}, {:.2f} ms for this first frame\n", o.output, row.label, device.name, time.ms);
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
    command->add_option("--image", o->image, "Write this intermediate image instead, e.g. depth, normal");
    command->add_option("--exposure", o->exposure, "For .png; 0 = 98th percentile to white")
        ->check(CLI::NonNegativeNumber);
    command->footer("Example: luxel render builtin:cornell --use isr:samples=80 -o picture.png");
    command->callback([o, &global] { run(*o, global); });
}

} // namespace luxel::app
