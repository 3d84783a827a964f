// SPDX-License-Identifier: MIT
// What an impostor of a heavy mesh saves in the camera's passes, and what its redraw costs. Variants
// alternate within one run; the counters hold medians of GPU time (milliseconds) of the G-buffer and the
// impostors.
#include <algorithm>
#include <memory>

#include <benchmark/benchmark.h>

#include "scene/procedural.h"
#include "scene/procedural_parts.h"
#include "techniques/frame/renderer.h"

namespace luxel {
namespace {

double median(std::vector<double> v) {
    std::nth_element(v.begin(), v.begin() + std::ptrdiff_t(v.size() / 2), v.end());
    return v[v.size() / 2];
}

// A ball of `triangles`, about, on a floor; the camera takes a step aside each frame.
struct Variant {
    Scene scene;
    std::unique_ptr<Renderer> renderer;
    std::vector<double> ms;
    float step;

    Variant(gpu::Gpu& gpu, int triangles, const Impostor& impostor, float meters) : step(meters) {
        procedural::add_quad_object(scene, procedural::lambertian("floor", glm::vec3(0.5f)), {-2, 0, 2},
                                    {4, 0, 0}, {0, 0, -4});
        const int stacks = int(std::sqrt(float(triangles) / 4.0f));
        add_sphere(procedural::add_object(scene, procedural::lambertian("ball", {0.6f, 0.4f, 0.3f})),
                   {0, 0.5f, 0}, 0.5f, 2 * stacks, stacks);
        scene.instances.back().impostor = impostor;
        scene.lights = {procedural::point_light({1, 2, 3}, 20.0f)};
        scene.cameras = {procedural::camera_at({0, 1, 4}, {0, 0.5f, 0}, 30.0f)};
        FrameOptions options;
        options.shadow_size = 64;
        renderer = std::make_unique<Renderer>(gpu, scene, options);
    }
    void frame() {
        scene.cameras[0].position.x += step;
        double sum = 0;
        for (const gpu::PassTime& pass :
             renderer->render({.camera = scene.cameras.front(), .width = 512, .height = 512}).passes)
            if (pass.name.find("gbuffer") != std::string::npos ||
                pass.name.find("impostor") != std::string::npos)
                sum += pass.ms;
        ms.push_back(sum);
    }
};

void impostors_time(benchmark::State& state) {
    gpu::Gpu gpu;
    const int triangles = int(state.range(0));
    const Impostor board{.kind = ImpostorKind::nailboard}, flat{.kind = ImpostorKind::billboard};
    const Impostor cloud{.kind = ImpostorKind::billboard_cloud, .distance = 0.02f};
    Impostor impatient = board;
    impatient.error = 0.01f;
    Variant mesh(gpu, triangles, {}, 0), kept(gpu, triangles, board, 0), billboard(gpu, triangles, flat, 0),
        redrawn(gpu, triangles, impatient, 0.01f), planes(gpu, triangles, cloud, 0);
    const auto all = {&mesh, &kept, &billboard, &redrawn, &planes};
    for (Variant* v : all) v->frame(), v->ms.clear();
    for (auto _ : state)
        for (Variant* v : all) v->frame();
    state.counters["ms_mesh"] = median(mesh.ms);
    state.counters["ms_nailboard_kept"] = median(kept.ms);
    state.counters["ms_billboard_kept"] = median(billboard.ms);
    state.counters["ms_nailboard_redrawn"] = median(redrawn.ms);
    state.counters["ms_cloud"] = median(planes.ms);
}
BENCHMARK(impostors_time)
    ->Arg(10000)
    ->Arg(100000)
    ->Arg(1000000)
    ->Iterations(9)
    ->Unit(benchmark::kMillisecond);

} // namespace
} // namespace luxel
