// SPDX-License-Identifier: MIT
// What the path tracer costs beyond its rays: the rays of a run are recorded and asked again of bare Embree
// in the same order, on the same threads, through the same API; both runs alternate and their medians are
// compared.
#include <algorithm>
#include <chrono>

#include <benchmark/benchmark.h>
#include <embree3/rtcore.h>

#include "core/parallel.h"
#include "reference/path_tracer.h"
#include "scene/load.h"
#include "scene/procedural.h"
#include "support/data.h"

namespace luxel {
namespace {

constexpr int width = 128, height = 96, tile = 16, samples = 16;
constexpr std::size_t tiles = std::size_t(width / tile) * std::size_t(height / tile);

ReferenceRequest request_for(const Scene& scene, int w, int h) {
    ReferenceRequest request;
    request.components = {"full"};
    request.width = w, request.height = h;
    request.camera = scene.cameras[0];
    return request;
}

// Traces one tile; the sum keeps the work from being optimized away.
float trace_tile(const PathTracer& tracer, std::size_t index) {
    float sum = 0.0f;
    const int left = int(index) % (width / tile) * tile, top = int(index) / (width / tile) * tile;
    for (int y = top; y < top + tile; ++y)
        for (int x = left; x < left + tile; ++x)
            tracer.trace_samples(x, y, 0, samples, {}, [&](int, const PathSample& s) { sum += s.full().g; });
    return sum;
}

RTCRay embree_ray(const Ray& r) {
    return {r.origin.x, r.origin.y, r.origin.z, r.t_min, r.direction.x, r.direction.y, r.direction.z, 0.0f,
            r.t_max,    ~0u,        0,          0};
}

// The same queries without a path tracer around them.
std::size_t replay(RTCScene scene, const RayLog& log) {
    std::size_t hits = 0;
    for (const RayLog::Entry& entry : log.entries) {
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        if (entry.shadow) {
            RTCRay ray = embree_ray(entry.ray);
            rtcOccluded1(scene, &context, &ray);
            hits += ray.tfar < 0.0f;
        } else {
            RTCRayHit query;
            query.ray = embree_ray(entry.ray);
            query.hit.geomID = query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
            rtcIntersect1(scene, &context, &query);
            hits += query.hit.geomID != RTC_INVALID_GEOMETRY_ID;
        }
    }
    return hits;
}

template <class Work> double seconds(Work&& work) {
    auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double median(std::vector<double> values) {
    std::nth_element(values.begin(), values.begin() + std::ptrdiff_t(values.size() / 2), values.end());
    return values[values.size() / 2];
}

void compare(benchmark::State& state, const Scene& scene) {
    RayCaster rays(scene);
    ReferenceRequest request = request_for(scene, width, height);
    PathTracer tracer(rays, request);

    // Record; each tile has its own log, as each is one task of one thread.
    std::vector<RayLog> logs(tiles);
    parallel_for(tiles, 1, [&](std::size_t i) {
        PathTracerOptions options;
        options.log = &logs[i];
        trace_tile(PathTracer(rays, request, options), i);
    });
    std::size_t count = 0;
    for (const RayLog& log : logs) count += log.entries.size();

    std::vector<double> traced, bare, ratios;
    auto* tree = static_cast<RTCScene>(rays.embree_scene());
    for (auto _ : state) {
        traced.push_back(seconds([&] {
            parallel_for(tiles, 1, [&](std::size_t i) { benchmark::DoNotOptimize(trace_tile(tracer, i)); });
        }));
        bare.push_back(seconds([&] {
            parallel_for(tiles, 1, [&](std::size_t i) { benchmark::DoNotOptimize(replay(tree, logs[i])); });
        }));
        ratios.push_back(bare.back() / traced.back());
    }
    state.counters["triangles"] = double(scene.triangles());
    state.counters["rays"] = double(count);
    state.counters["tracer_rays/s"] = double(count) / median(traced);
    state.counters["embree_rays/s"] = double(count) / median(bare);
    state.counters["ratio"] = median(ratios);
}

void rays_of_subdivided_cornell(benchmark::State& state) { compare(state, subdivide(cornell(), 6)); }

void rays_of_sponza(benchmark::State& state) {
    auto file = testing::data_file("sponza_crytek/sponza_crytek.gltf");
    if (!file) return state.SkipWithError("no Sponza on this machine");
    compare(state, load_scene(file->string()));
}

void cornell_256(benchmark::State& state) {
    Scene scene = cornell();
    RayCaster rays(scene);
    ReferenceRequest request = request_for(scene, 256, 256);
    request.settings.spp = 4;
    for (auto _ : state) benchmark::DoNotOptimize(render_reference(rays, request));
    state.counters["samples/s"] =
        benchmark::Counter(256.0 * 256.0 * 4.0, benchmark::Counter::kIsIterationInvariantRate);
}

BENCHMARK(rays_of_subdivided_cornell)->Iterations(9)->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK(rays_of_sponza)->Iterations(9)->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK(cornell_256)->UseRealTime()->Unit(benchmark::kMillisecond);

} // namespace
} // namespace luxel
