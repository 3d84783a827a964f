// SPDX-License-Identifier: MIT
// What a photon costs: passes of photons over a small image, by scene. Items are photons.
#include <benchmark/benchmark.h>

#include "reference/caustics.h"
#include "scene/load.h"

namespace luxel {
namespace {

void trace_photons(benchmark::State& state, const char* name) {
    const Scene scene = load_scene(name);
    const RayCaster rays(scene);
    ReferenceRequest request;
    request.components = {"caustics"};
    request.width = request.height = 64;
    request.camera = scene.cameras[0];
    const CausticTracer tracer(rays, request);
    int pass = 0;
    for (auto _ : state) tracer.trace_pass(pass++, [](int, int, glm::vec3, glm::vec3) {});
    state.SetItemsProcessed(std::int64_t(pass) * request.settings.photons);
}

BENCHMARK_CAPTURE(trace_photons, metal_ring, "builtin:metal-ring")->MeasureProcessCPUTime();
BENCHMARK_CAPTURE(trace_photons, glass_sphere, "builtin:glass-sphere")->MeasureProcessCPUTime();
BENCHMARK_CAPTURE(trace_photons, glass_metal, "builtin:glass-metal")->MeasureProcessCPUTime();
BENCHMARK_CAPTURE(trace_photons, water, "builtin:water")->MeasureProcessCPUTime();

} // namespace
} // namespace luxel
