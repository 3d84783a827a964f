// SPDX-License-Identifier: MIT
// Cost of the occlusion techniques at equal samples, and what the 4x4 pattern buys for its filter. Variants
// take turns frame by frame; counters hold medians of GPU time in milliseconds, ratios of medians with the
// ends of their 95 % bootstrap interval, and mean errors against ray-traced occlusion of the same radius.
#include <algorithm>
#include <memory>
#include <random>
#include <string>

#include <benchmark/benchmark.h>

#include "reference/reference.h"
#include "scene/procedural.h"
#include "techniques/frame/renderer.h"

namespace luxel {
namespace {

constexpr int width = 512, height = 384, rounds = 31;
constexpr float radius = 0.3f;

double median(std::vector<double> v) {
    std::nth_element(v.begin(), v.begin() + std::ptrdiff_t(v.size() / 2), v.end());
    return v[v.size() / 2];
}

struct Ratio {
    double value, low, high;
};

// Rounds are resampled as a whole: what disturbed one variant of a round disturbed the others as well.
Ratio ratio_of_medians(const std::vector<double>& a, const std::vector<double>& b) {
    std::mt19937 random(1);
    std::vector<double> ratios, x(a.size()), y(a.size());
    for (int i = 0; i < 4000; ++i) {
        for (std::size_t k = 0; k < a.size(); ++k) {
            std::size_t pick = random() % a.size();
            x[k] = a[pick], y[k] = b[pick];
        }
        ratios.push_back(median(x) / median(y));
    }
    std::sort(ratios.begin(), ratios.end());
    return {median(a) / median(b), ratios[100], ratios[3899]};
}

struct Variant {
    std::string use;
    std::unique_ptr<Technique> technique;
    std::vector<double> ms;
    Image accessibility, mask;

    explicit Variant(const std::string& text)
        : use(text),
          technique(make_technique(parse_specification(text + ",radius=" + std::to_string(radius)))) {}
};

// Every variant's frames in turn, the first round not counted (shaders are compiled then).
void measure(std::vector<Variant>& variants, const Scene& scene) {
    gpu::Gpu gpu;
    FrameOptions options;
    options.emitter_lights = 1, options.shadow_size = 64, options.environment = EnvironmentMode::none;
    Renderer renderer(gpu, scene, options);
    for (int round = 0; round <= rounds; ++round)
        for (Variant& v : variants) {
            RenderRequest request{.camera = scene.cameras.front(),
                                  .width = width,
                                  .height = height,
                                  .techniques = {v.technique.get()},
                                  .images = {"accessibility"}};
            RenderResult result = renderer.render(request);
            double sum = 0.0;
            for (const gpu::PassTime& pass : result.passes)
                if (pass.name.starts_with(v.use.substr(0, v.use.find(':')))) sum += pass.ms;
            if (round > 0) v.ms.push_back(sum);
            v.accessibility = result.images.at("accessibility"), v.mask = result.mask;
        }
}

// argument: samples
void occlusion_cost(benchmark::State& state) {
    const std::string samples = ":samples=" + std::to_string(state.range(0));
    std::vector<Variant> variants;
    for (const char* name : {"ssao", "containment", "volumetric"}) variants.emplace_back(name + samples);
    for (auto _ : state) measure(variants, shapes(ShapesLight::point));
    for (const Variant& v : variants) {
        const std::string name = v.use.substr(0, v.use.find(':'));
        state.counters[name + "_ms"] = median(v.ms);
        Ratio ratio = ratio_of_medians(v.ms, variants.front().ms);
        if (&v == &variants.front()) continue;
        state.counters[name + "_over_ssao"] = ratio.value;
        state.counters[name + "_over_ssao_low"] = ratio.low;
        state.counters[name + "_over_ssao_high"] = ratio.high;
    }
}
BENCHMARK(occlusion_cost)->Arg(8)->Arg(16)->Arg(32)->Iterations(1)->Unit(benchmark::kMillisecond);

double mean_error(const Image& a, const Image& b, const Image& mask) {
    double sum = 0.0, count = 0.0;
    for (std::size_t i = 0; i < mask.data.size(); ++i)
        if (mask.data[i] > 0.0f) sum += std::abs(double(a.data[i]) - double(b.data[i])), ++count;
    return sum / count;
}

Image ray_traced(const Scene& scene) {
    RayCaster rays(scene);
    ReferenceRequest request{
        .components = {"ao"}, .width = width, .height = height, .camera = scene.cameras.front()};
    request.settings.spp = 256, request.settings.pixel_center = true;
    request.settings.ao_radius = radius, request.settings.ao_membership = Membership::tangent;
    const Image rgb = render_reference(rays, request).mean.at("ao");
    Image truth(rgb.width, rgb.height, 1);
    for (int y = 0; y < rgb.height; ++y)
        for (int x = 0; x < rgb.width; ++x) *truth.at(x, y) = rgb.rgb(x, y).r;
    return truth;
}

// Volumetric occlusion with the pattern at n samples, and without it at all numbers of samples up to the
// greatest: the error that the time of the first buys without the pattern lies between its neighbors in time.
void occlusion_pattern(benchmark::State& state) {
    const int samples = int(state.range(0));
    Scene scene = cornell();
    std::vector<Variant> variants;
    variants.emplace_back("volumetric:samples=" + std::to_string(samples));
    for (int n : {4, 8, 16, 24, 32, 48, 64})
        variants.emplace_back("volumetric:pattern=none,samples=" + std::to_string(n));
    for (auto _ : state) measure(variants, scene);
    Image truth = ray_traced(scene);
    const Variant& with = variants.front();
    state.counters["with_ms"] = median(with.ms);
    state.counters["with_error"] = mean_error(with.accessibility, truth, with.mask);
    const Variant* best = &variants[1];
    for (const Variant& v : variants)
        if (&v != &with && median(v.ms) <= median(with.ms)) best = &v;
    state.counters["without_samples"] = double(std::stoi(best->use.substr(best->use.find("samples=") + 8)));
    state.counters["without_ms"] = median(best->ms);
    state.counters["without_error"] = mean_error(best->accessibility, truth, best->mask);
}
BENCHMARK(occlusion_pattern)->Arg(4)->Arg(8)->Arg(16)->Arg(32)->Iterations(1)->Unit(benchmark::kMillisecond);

} // namespace
} // namespace luxel
