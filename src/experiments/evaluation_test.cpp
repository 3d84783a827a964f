// SPDX-License-Identifier: MIT
// What an evaluation refuses.
#include <gtest/gtest.h>

#include "core/error.h"
#include "experiments/evaluation.h"
#include "scene/load.h"

namespace luxel {
namespace {

struct Light : Technique {
    Slot slot() const override { return Slot::diffuse; }
    Contribution render(gpu::Recorder& recorder, const Frame& frame) override {
        Contribution c{.radiance = recorder.image({frame.width, frame.height}, "light")};
        recorder.clear(c.radiance, {});
        return c;
    }
};

TEST(Evaluation, ARowWithoutAccessibilityCannotBeHeldAgainstOcclusion) {
    std::vector<TechniqueRow> rows;
    rows.push_back(baseline_row());
    rows.push_back({.label = "light", .name = "light"});
    rows[1].techniques.push_back(std::make_unique<Light>());
    const Scene scene = load_scene("builtin:cornell");
    const RayCaster rays(scene);
    gpu::Gpu gpu{gpu::GpuOptions{}};
    Renderer renderer(gpu, scene, {});
    const ViewTask task = {.camera = scene.cameras[0], .width = 16, .height = 16};
    const TruthSettings truth = {.components = {"ao"}, .spp = 2};
    try {
        evaluate_view({renderer, rays, {}}, task, truth, rows,
                      [](const ViewPictures&) { return nlohmann::ordered_json(); });
        FAIL() << "it was evaluated";
    } catch (const Error& e) {
        EXPECT_EQ(e.fault(), Fault::usage);
        EXPECT_NE(std::string(e.what()).find("delivers no accessibility"), std::string::npos) << e.what();
    }
}

} // namespace
} // namespace luxel
