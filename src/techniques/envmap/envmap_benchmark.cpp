// SPDX-License-Identifier: MIT
// Cost of the estimators beside each other [Umenhoffer2009, tables 3.1 and 3.2]. Variants alternate within
// one run; the counters hold medians of GPU time (milliseconds) of the pass that shades, and ratios of it.
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

struct Estimator {
    std::unique_ptr<Technique> technique;
    std::vector<double> shading, probe;

    explicit Estimator(const std::string& parameters)
        : technique(make_technique(parse_specification("envmap:" + parameters))) {}
    void frame(Renderer& renderer, const Camera& camera) {
        RenderRequest request{.camera = camera, .width = 512, .height = 512, .techniques = {technique.get()}};
        double shade = 0, rest = 0;
        for (const gpu::PassTime& pass : renderer.render(request).passes)
            if (pass.name.starts_with("envmap"))
                (pass.name.find("/gather_") != std::string::npos ? shade : rest) += pass.ms;
        shading.push_back(shade), probe.push_back(rest);
    }
};

void envmap_estimators(benchmark::State& state) {
    gpu::Gpu gpu;
    const Scene scene = ball_room(BallPlace::face, 1.0f, BallLight::lamps);
    Renderer renderer(gpu, scene, {});
    const std::string m = ",texels=" + std::to_string(state.range(0));
    Estimator classic("estimator=classic" + m), point("estimator=point" + m),
        polygon("estimator=polygon" + m);
    for (Estimator* e : {&classic, &point, &polygon}) {
        e->frame(renderer, scene.cameras.back());
        e->shading.clear(), e->probe.clear();
    }
    for (auto _ : state)
        for (Estimator* e : {&classic, &point, &polygon}) e->frame(renderer, scene.cameras.back());
    state.counters["ms_classic"] = median(classic.shading);
    state.counters["ms_point"] = median(point.shading);
    state.counters["ms_polygon"] = median(polygon.shading);
    state.counters["ms_probe"] = median(polygon.probe);
    state.counters["point_over_classic"] = median(point.shading) / median(classic.shading);
    state.counters["polygon_over_point"] = median(polygon.shading) / median(point.shading);
}
BENCHMARK(envmap_estimators)->Arg(4)->Arg(2)->Iterations(9)->Unit(benchmark::kMillisecond);

} // namespace
} // namespace luxel
