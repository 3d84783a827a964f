// SPDX-License-Identifier: MIT
// Cost of image-space radiosity: linear in samples, independent of geometry. Variants alternate within one
// run and the counters hold medians of GPU time (milliseconds) and their ratios.
#include <algorithm>
#include <memory>
#include <string>

#include <benchmark/benchmark.h>

#include "scene/procedural.h"
#include "techniques/frame/renderer.h"

namespace luxel {
namespace {

double median(std::vector<double> v) {
    std::nth_element(v.begin(), v.begin() + std::ptrdiff_t(v.size() / 2), v.end());
    return v[v.size() / 2];
}

// One scene with one technique configuration; frames() collects the time of the technique's own passes.
struct Variant {
    Scene scene;
    std::unique_ptr<Technique> isr;
    std::unique_ptr<Renderer> renderer;
    std::vector<double> ms;

    Variant(gpu::Gpu& gpu, Scene s, int samples) : scene(std::move(s)) {
        isr = make_technique(parse_specification("isr:samples=" + std::to_string(samples)));
        FrameOptions options;
        options.emitter_lights = 1;
        renderer = std::make_unique<Renderer>(gpu, scene, options);
    }
    void frame() {
        RenderRequest request{
            .camera = scene.cameras.front(), .width = 512, .height = 512, .techniques = {isr.get()}};
        double sum = 0;
        for (const gpu::PassTime& pass : renderer->render(request).passes)
            if (pass.name.starts_with("isr")) sum += pass.ms;
        ms.push_back(sum);
    }
};

void isr_time_over_samples(benchmark::State& state) {
    gpu::Gpu gpu;
    Variant a(gpu, cornell(), 24), b(gpu, cornell(), 48), c(gpu, cornell(), 80);
    for (Variant* v : {&a, &b, &c}) v->frame(), v->ms.clear();
    for (auto _ : state)
        for (Variant* v : {&a, &b, &c}) v->frame();
    double t24 = median(a.ms), t48 = median(b.ms), t80 = median(c.ms);
    double line = t48 + (t48 - t24) / 24.0 * 32.0;
    state.counters["ms_24"] = t24;
    state.counters["ms_48"] = t48;
    state.counters["ms_80"] = t80;
    state.counters["ms_80_over_line"] = t80 / line;
}
BENCHMARK(isr_time_over_samples)->Iterations(15)->Unit(benchmark::kMillisecond);

void isr_time_over_triangles(benchmark::State& state) {
    gpu::Gpu gpu;
    Variant once(gpu, cornell(), 80), subdivided(gpu, subdivide(cornell(), 2), 80);
    for (Variant* v : {&once, &subdivided}) v->frame(), v->ms.clear();
    for (auto _ : state)
        for (Variant* v : {&once, &subdivided}) v->frame();
    state.counters["ms"] = median(once.ms);
    state.counters["ms_x16"] = median(subdivided.ms);
    state.counters["ratio"] = median(subdivided.ms) / median(once.ms);
}
BENCHMARK(isr_time_over_triangles)->Iterations(15)->Unit(benchmark::kMillisecond);

} // namespace
} // namespace luxel
