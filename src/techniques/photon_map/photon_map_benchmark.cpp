// SPDX-License-Identifier: MIT
// Cost of tracing photons: over photons, tracers, resolutions, triangles, scenes. Variants alternate within
// one run; the counters hold the least time of each (milliseconds of a submit that does nothing else) and
// ratios.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>

#include <benchmark/benchmark.h>

#include "scene/procedural.h"
#include "techniques/photon_map/test_rays.h"

namespace luxel {
namespace {

constexpr int photons = 16384;

double run(gpu::Recorder& recorder) {
    const auto start = std::chrono::steady_clock::now();
    recorder.submit();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

// Rays of one scene in its lists.
struct Rays {
    gpu::Gpu& gpu;
    Scene scene;
    PhotonOptions options;
    std::vector<TestRay> rays;
    std::unique_ptr<GpuScene> on_gpu;
    FragmentLists lists;
    PhotonBuffers buffers;
    double capture_ms = std::numeric_limits<double>::max(), trace_ms = capture_ms;

    Rays(gpu::Gpu& g, Scene s, int count, PhotonTracer tracer = PhotonTracer::march, int side = 256)
        : gpu(g), scene(std::move(s)), rays(specular_rays(scene, count)) {
        options.tracer = tracer, options.side = side;
        on_gpu = std::make_unique<GpuScene>(gpu, scene, false);
        lists = FragmentLists(gpu, scene);
        capture();
        buffers = upload_rays(gpu, rays, lists.view().center);
        trace(); // shaders are built on their first use
        capture_ms = trace_ms = std::numeric_limits<double>::max();
    }
    void capture() {
        const ListProjection view = list_view_of_camera(view_params(scene.cameras.front(), 512, 512),
                                                        scene.bounds(), options.side, options.margin);
        gpu::Recorder recorder(gpu);
        const auto start = std::chrono::steady_clock::now();
        capture_lists(recorder, lists, *on_gpu, view, options);
        recorder.submit();
        const auto end = std::chrono::steady_clock::now();
        capture_ms = std::min(capture_ms, std::chrono::duration<double, std::milli>(end - start).count());
    }
    void trace() {
        gpu::Recorder recorder(gpu);
        trace_photons(recorder, lists, buffers, options);
        trace_ms = std::min(trace_ms, run(recorder));
    }
};

void trace_alternating(benchmark::State& state, std::initializer_list<Rays*> all) {
    for (auto _ : state)
        for (Rays* r : all) r->trace();
}

void photon_trace_over_photons(benchmark::State& state) {
    gpu::Gpu gpu;
    Rays a(gpu, ring(), photons / 4), b(gpu, ring(), photons), c(gpu, ring(), 4 * photons);
    trace_alternating(state, {&a, &b, &c});
    state.counters["ms_4k"] = a.trace_ms;
    state.counters["ms_16k"] = b.trace_ms;
    state.counters["ms_64k"] = c.trace_ms;
    state.counters["64k_over_line"] = c.trace_ms / (b.trace_ms + (b.trace_ms - a.trace_ms) * 4.0);
}
BENCHMARK(photon_trace_over_photons)->Iterations(15)->Unit(benchmark::kMillisecond);

void photon_trace_tracers(benchmark::State& state) {
    gpu::Gpu gpu;
    Rays march(gpu, ring(), photons), lines(gpu, ring(), photons, PhotonTracer::lines),
        coarse(gpu, ring(), photons, PhotonTracer::march, 128),
        coarse_lines(gpu, ring(), photons, PhotonTracer::lines, 128);
    trace_alternating(state, {&march, &lines, &coarse, &coarse_lines});
    state.counters["march_128"] = coarse.trace_ms;
    state.counters["march_256"] = march.trace_ms;
    state.counters["lines_128"] = coarse_lines.trace_ms;
    state.counters["lines_256"] = lines.trace_ms;
    state.counters["lines_over_march"] = lines.trace_ms / march.trace_ms;
}
BENCHMARK(photon_trace_tracers)->Iterations(15)->Unit(benchmark::kMillisecond);

void photon_trace_over_triangles(benchmark::State& state) {
    gpu::Gpu gpu;
    Rays once(gpu, ring(), photons), divided(gpu, subdivide(ring(), 3), photons);
    for (auto _ : state)
        for (Rays* r : {&once, &divided}) r->capture(), r->trace();
    state.counters["ms"] = once.trace_ms;
    state.counters["ms_x64"] = divided.trace_ms;
    state.counters["ratio"] = divided.trace_ms / once.trace_ms;
    state.counters["capture_ms"] = once.capture_ms;
    state.counters["capture_ms_x64"] = divided.capture_ms;
}
BENCHMARK(photon_trace_over_triangles)->Iterations(15)->Unit(benchmark::kMillisecond);

// What the driver executes for a ray: eight of them go in lockstep, as far as the one that goes farthest.
struct Steps {
    double cells = 0, nodes = 0; // a ray
};
Steps steps_in_lockstep(Rays& r) {
    constexpr std::size_t lanes = 8;
    const auto hits = r.gpu.read_all<shared::PhotonHit>(r.buffers.hits);
    Steps steps;
    for (std::size_t first = 0; first < hits.size(); first += lanes) {
        shared::uint cells = 0, nodes = 0;
        for (std::size_t i = first; i < std::min(first + lanes, hits.size()); ++i)
            cells = std::max(cells, hits[i].cells), nodes = std::max(nodes, hits[i].nodes);
        steps.cells += double(cells), steps.nodes += double(nodes);
    }
    const double groups = std::ceil(double(hits.size()) / double(lanes));
    return {steps.cells / groups, steps.nodes / groups};
}

// Nanoseconds for each cell and each node: the two constants that explain the times of all scenes best, and
// how far each scene is off them.
void photon_trace_per_visit(benchmark::State& state) {
    gpu::Gpu gpu;
    std::vector<std::unique_ptr<Rays>> all;
    for (Scene& scene : std::vector<Scene>{metal_ring(), water(0.0f), ring(), occluded_ring(),
                                           water_room(0.0f), bunnies_ring()})
        all.push_back(std::make_unique<Rays>(gpu, std::move(scene), photons));
    for (auto _ : state)
        for (auto& r : all) r->trace();

    // Least squares of relative errors: rows (cells, nodes) / time, right side 1.
    glm::dmat2 normal(0.0);
    glm::dvec2 right(0.0);
    std::vector<glm::dvec2> rows;
    for (auto& r : all) {
        const Steps steps = steps_in_lockstep(*r);
        const double ns = r->trace_ms * 1e6 / double(r->rays.size());
        rows.push_back(glm::dvec2(steps.cells, steps.nodes) / ns);
        normal += glm::outerProduct(rows.back(), rows.back()), right += rows.back();
    }
    const glm::dvec2 cost = glm::inverse(normal) * right;
    state.counters["ns_cell"] = cost.x, state.counters["ns_node"] = cost.y;
    for (std::size_t i = 0; i < all.size(); ++i)
        state.counters[all[i]->scene.name + "_off"] = glm::dot(cost, rows[i]) - 1.0;
}
BENCHMARK(photon_trace_per_visit)->Iterations(15)->Unit(benchmark::kMillisecond);

} // namespace
} // namespace luxel
