// SPDX-License-Identifier: MIT
// Gathering at regions against gathering at every pixel, alternating within one run: the least time, error
// relative to the mean; what kernels and shadow maps cost. Milliseconds; on a CPU driver of processor time of
// all cores, since that is not lengthened by other work on the machine. Sponza where its files are.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <functional>
#include <memory>

#include <benchmark/benchmark.h>

#include "scene/load.h"
#include "scene/procedural.h"
#include "support/data.h"
#include "techniques/frame/renderer.h"
#include "techniques/vpl/vpl.h"

namespace luxel {
namespace {

// Keeps a frame and its lights.
struct KeepFrame final : Technique {
    VplTechniqueOptions options;
    Frame frame;
    VplSenders senders;
    Slot slot() const override { return Slot::post; }
    Contribution render(gpu::Recorder& recorder, const Frame& f) override {
        frame = f;
        senders.vpls = sample_vpls(recorder, reflective_shadow_maps(recorder, f, options.rsm), options.vpls);
        return {};
    }
};

struct Stage {
    gpu::Gpu gpu;
    Scene scene;
    std::unique_ptr<Renderer> renderer;
    KeepFrame kept;

    Stage(Scene s, int size) : scene(std::move(s)) {
        FrameOptions options;
        options.emitter_lights = 0, options.environment = EnvironmentMode::none;
        renderer = std::make_unique<Renderer>(gpu, scene, options);
        kept.options.rsm.lights = {.emitters = 2, .environment = 0};
        kept.options.vpls.count = 256; // [Le2014, chapter 4]
        renderer->render(
            {.camera = scene.cameras.at(0), .width = size, .height = size, .techniques = {&kept}});
    }
    double now() const {
        if (gpu.device().type == "cpu") return 1e3 * double(std::clock()) / CLOCKS_PER_SEC;
        return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now().time_since_epoch())
            .count();
    }
    // Time that what is recorded takes.
    double ms(const std::function<void(gpu::Recorder&)>& record) {
        gpu::Recorder recorder(gpu);
        record(recorder);
        const double start = now();
        recorder.submit();
        return now() - start;
    }
    gpu::Image irradiance(gpu::Recorder& recorder, VplGather gather, const VplRegionOptions& regions = {}) {
        VplTechniqueOptions options = kept.options;
        options.gather = gather, options.regions = regions;
        return vpl_irradiance(recorder, kept.frame, kept.senders, options);
    }
};

double least(const std::vector<double>& v) { return *std::min_element(v.begin(), v.end()); }

struct Closeness {
    double regions, rmse; // of the pixels that see something; relative to their mean
};

Closeness closeness(Stage& stage, const VplRegionOptions& options) {
    gpu::Image full, fast;
    VplRegions regions;
    stage.ms([&](gpu::Recorder& r) {
        full = stage.irradiance(r, VplGather::full), fast = stage.irradiance(r, VplGather::multires, options);
        regions = vpl_regions(r, stage.kept.frame, options);
    });
    const Image a = stage.gpu.read(full), b = stage.gpu.read(fast.mip(0));
    double squares = 0.0, sum = 0.0, pixels = 0.0, count = 0.0;
    for (int y = 0; y < a.height; ++y)
        for (int x = 0; x < a.width; ++x) {
            squares += std::pow(double(luminance(a.rgb(x, y) - b.rgb(x, y))), 2.0);
            sum += double(luminance(a.rgb(x, y))), pixels += double(a.at(x, y)[3]);
        }
    for (int c : stage.gpu.read_all<int>(regions.counts)) count += c;
    return {count / pixels, std::sqrt(squares / pixels) / (sum / pixels)};
}

void compare(benchmark::State& state, Scene scene) {
    Stage stage(std::move(scene), int(state.range(0)));
    std::vector<double> full, multires, divide, interpolate;
    const auto once = [&] {
        full.push_back(stage.ms([&](gpu::Recorder& r) { stage.irradiance(r, VplGather::full); }));
        multires.push_back(stage.ms([&](gpu::Recorder& r) { stage.irradiance(r, VplGather::multires); }));
        VplRegions regions;
        divide.push_back(stage.ms([&](gpu::Recorder& r) {
            regions = vpl_regions(r, stage.kept.frame, stage.kept.options.regions);
        }));
        stage.ms([&](gpu::Recorder& r) {
            vpl_shade(r, stage.kept.frame, stage.kept.senders, stage.kept.options, regions);
        });
        interpolate.push_back(stage.ms([&](gpu::Recorder& r) { vpl_interpolate(r, regions); }));
    };
    once(), full.clear(), multires.clear(), divide.clear(), interpolate.clear();
    for (auto _ : state) once();
    const Closeness c = closeness(stage, {});
    state.counters["ms_full"] = least(full);
    state.counters["ms_multires"] = least(multires);
    const double overhead = least(divide) + least(interpolate);
    state.counters["ms_divide"] = least(divide);
    state.counters["ms_interpolate"] = least(interpolate);
    state.counters["regions"] = c.regions;
    state.counters["rmse"] = c.rmse;
    state.counters["of_full"] = least(multires) / least(full);
    // At most 1.3 where shading a region costs what shading a pixel does.
    state.counters["per_region"] = (least(multires) - overhead) / (least(full) * c.regions);
}

void vpl_cornell(benchmark::State& state) { compare(state, cornell()); }
BENCHMARK(vpl_cornell)->Arg(512)->Arg(1024)->Iterations(7)->Unit(benchmark::kMillisecond);

void vpl_sponza(benchmark::State& state) {
    const auto file = testing::data_file("sponza_crytek/sponza_crytek.gltf");
    if (file)
        compare(state, load_scene(file->string()));
    else
        state.SkipWithError("no sponza_crytek on this machine");
}
BENCHMARK(vpl_sponza)->Arg(512)->Arg(1024)->Iterations(7)->Unit(benchmark::kMillisecond);

// Error over regions, by the bounds of both discontinuities in thousandths.
void vpl_sponza_error_over_regions(benchmark::State& state) {
    const auto file = testing::data_file("sponza_crytek/sponza_crytek.gltf");
    if (!file) return state.SkipWithError("no sponza_crytek on this machine");
    Stage stage(load_scene(file->string()), 512);
    VplRegionOptions options;
    options.depth_step = 1e-3f * float(state.range(0)), options.normal_step = 1e-3f * float(state.range(1));
    Closeness c{};
    for (auto _ : state) c = closeness(stage, options);
    state.counters["regions"] = c.regions;
    state.counters["rmse"] = c.rmse;
}
BENCHMARK(vpl_sponza_error_over_regions)
    ->Args({5, 50})
    ->Args({10, 100})
    ->Args({20, 200})
    ->Args({40, 400})
    ->Args({80, 800})
    ->Args({320, 2000})
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);

// Gathering at every pixel by kernel, and with imperfect shadow maps, which are drawn apart.
void vpl_kernels(benchmark::State& state) {
    Stage stage(cornell(), 512);
    VplSenders shadowed = stage.kept.senders;
    const VplTechniqueOptions& o = stage.kept.options;
    const IsmPoints points = ism_points(stage.gpu, stage.scene, o.ism);
    std::vector<double> ms[5];
    for (auto _ : state) {
        for (int mode = 0; mode < 3; ++mode) {
            stage.kept.options.mode = VplMode(mode);
            ms[mode].push_back(stage.ms([&](gpu::Recorder& r) { stage.irradiance(r, VplGather::full); }));
        }
        ms[3].push_back(stage.ms([&](gpu::Recorder& r) {
            shadowed.ism = imperfect_shadow_maps(r, stage.kept.frame, points, shadowed.vpls, o.ism);
        }));
        stage.kept.options.mode = VplMode::disc;
        ms[4].push_back(
            stage.ms([&](gpu::Recorder& r) { vpl_irradiance(r, stage.kept.frame, shadowed, o); }));
    }
    const char* names[] = {"ms_disc", "ms_bounded", "ms_thesis", "ms_shadow_maps", "ms_shadowed"};
    for (int i = 0; i < 5; ++i) state.counters[names[i]] = least(ms[i]);
}
BENCHMARK(vpl_kernels)->Iterations(7)->Unit(benchmark::kMillisecond);

} // namespace
} // namespace luxel
