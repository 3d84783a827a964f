// SPDX-License-Identifier: MIT
// Lights drawn by what they send to the view: where they stand, and that nothing is lost or gained.
#include "techniques/vpl/importance.h"

#include <gtest/gtest.h>

#include "scene/procedural.h"
#include "scene/procedural_parts.h"
#include "support/gpu.h"
#include "techniques/frame/renderer.h"
#include "techniques/vpl/importance_params.h"
#include "techniques/vpl/vpl.h"

namespace luxel {
namespace {

using glm::vec3, glm::vec4;

struct DrawnLights {
    std::vector<vec3> positions;
    vec3 flux{0.0f};
};

// Draws lights, and gathers both them and all candidates.
struct ImportanceProbe final : Technique {
    int wanted = 128;
    VplImportanceOptions importance{.candidates = 32};
    bool shadows = true;
    IsmPoints points;
    VplSenders all, drawn;
    gpu::Image by_all, by_drawn;
    Slot slot() const override { return Slot::post; }
    void prepare(gpu::Gpu& gpu, const Scene& scene) override {
        points = ism_points(gpu, scene, {}, scene.cameras[0].position);
    }
    Contribution render(gpu::Recorder& recorder, const Frame& frame) override {
        all.vpls = sample_vpls(recorder, reflective_shadow_maps(recorder, frame, {.size = 256}),
                               {.count = wanted * importance.candidates});
        drawn.vpls =
            resample_vpls(recorder, frame, all.vpls, wanted, importance, shadows ? &points : nullptr);
        VplTechniqueOptions gather;
        gather.gather = VplGather::full;
        by_all = vpl_irradiance(recorder, frame, all, gather);
        by_drawn = vpl_irradiance(recorder, frame, drawn, gather);
        return {};
    }
};

class ImportanceTest : public testing::GpuTest {
protected:
    void run(ImportanceProbe& probe, const Scene& scene) {
        RenderRequest request{
            .camera = scene.cameras.at(0), .width = 40, .height = 30, .techniques = {&probe}};
        Renderer(gpu(), scene, {.emitter_lights = 0, .environment = EnvironmentMode::none}).render(request);
    }
    DrawnLights read(const Vpls& vpls) {
        const int count = gpu().read_all<int>(vpls.count).at(0);
        const std::vector<vec4> t = gpu().read_all<vec4>(vpls.lights);
        DrawnLights lights;
        for (std::size_t i = 0; i < std::size_t(count); ++i)
            lights.positions.emplace_back(t[3 * i]), lights.flux += vec3(t[3 * i + 2]);
        return lights;
    }
    double mean(const gpu::Image& irradiance) {
        const Image image = gpu().read(irradiance);
        double sum = 0;
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x) sum += double(luminance(image.rgb(x, y)));
        return sum;
    }
};

// Two closed rooms beside each other, a lamp in each; the camera is in the left one.
Scene two_rooms() {
    Scene scene = furnace(0.5f, 0.0f);
    const std::size_t walls = scene.instances.size();
    for (std::size_t i = 0; i < walls; ++i) {
        scene.instances.push_back(scene.instances[i]);
        scene.instances.back().transform[3] += vec4(2.5f, 0, 0, 0);
    }
    scene.lights = {procedural::point_light({0.3f, 0.2f, -0.4f}, 1.0f),
                    procedural::point_light({2.3f, 0.2f, -0.4f}, 1.0f)};
    scene.cameras = {procedural::camera_at({-0.5f, 0.3f, 0.8f}, {0.2f, -0.2f, 0}, 60.0f)};
    return scene;
}

TEST_F(ImportanceTest, LightsStandWhereTheViewSeesTheirLight) {
    ImportanceProbe probe;
    run(probe, two_rooms());
    auto share = [](const DrawnLights& lights) {
        double left = 0;
        for (vec3 p : lights.positions) left += p.x < 1.1f;
        return left / double(lights.positions.size());
    };
    EXPECT_NEAR(share(read(probe.all.vpls)), 0.5, 0.02);
    EXPECT_GT(share(read(probe.drawn.vpls)), 0.9);
}

// Half of the flux is in each room; a tenth of the lights, drawn by flux, carries that of the right one.
TEST_F(ImportanceTest, TogetherTheySendWhatAllCandidatesDo) {
    ImportanceProbe probe;
    run(probe, two_rooms());
    const DrawnLights all = read(probe.all.vpls), drawn = read(probe.drawn.vpls);
    EXPECT_LE(drawn.positions.size(), 129u);
    EXPECT_GT(drawn.positions.size(), 60u);
    EXPECT_NEAR(drawn.flux.g / all.flux.g, 1.0f, 0.1f);
    EXPECT_NEAR(mean(probe.by_drawn) / mean(probe.by_all), 1.0, 0.02);
}

TEST_F(ImportanceTest, WithoutVisibilityOrLampsItWorksToo) {
    ImportanceProbe probe;
    probe.shadows = false;
    run(probe, two_rooms());
    EXPECT_NEAR(mean(probe.by_drawn) / mean(probe.by_all), 1.0, 0.02);
    Scene dark = two_rooms();
    dark.lights.clear();
    run(probe, dark);
    EXPECT_TRUE(read(probe.drawn.vpls).positions.empty());
}

TEST(ImportanceMaths, SystematicSamplingDrawsAllOfThem) {
    int drawn = 0;
    float from = 0.0f;
    for (int i = 0; i < 37; ++i) {
        const float to = i == 36 ? 1.0f : from + (0.3f + float(i % 5)) / 90.0f;
        const int times = shared::times_drawn(from, to, 100);
        EXPECT_NEAR(float(times), (to - from) * 100.0f, 1.001f);
        drawn += times, from = to;
    }
    EXPECT_EQ(drawn, 100);
}

} // namespace
} // namespace luxel
