// SPDX-License-Identifier: MIT
// What techniques light in other views: on the camera's own view it is what they add to the frame.
#include <gtest/gtest.h>

#include "scene/procedural.h"
#include "support/gpu.h"
#include "techniques/frame/renderer.h"

namespace luxel {
namespace {

// Captures the camera's view as a mirror would another one.
struct SecondView final : Technique {
    Capture seen;
    Slot slot() const override { return Slot::specular; }
    Contribution render(gpu::Recorder& recorder, const Frame& frame) override {
        seen = frame.capture(recorder, {.view = frame.view, .prefix = "second "});
        frame.add_indirect(recorder, {seen});
        return {};
    }
};

class IndirectTest : public testing::GpuTest {
protected:
    void expect_same(const Scene& scene, const std::string& use, FrameOptions options = {}) {
        options.emitter_lights = 4;
        SecondView second;
        auto technique = use.empty() ? nullptr : make_technique(parse_specification(use));
        RenderRequest request{
            .camera = scene.cameras.at(0), .width = 48, .height = 48, .techniques = {&second}};
        if (technique) request.techniques.push_back(technique.get());
        const RenderResult result = Renderer(gpu(), scene, options).render(request);
        const Image again = gpu().read(second.seen.direct), direct = gpu().read(second.seen.direct_diffuse);
        double added = 0, difference = 0;
        for (int y = 0; y < 48; ++y)
            for (int x = 0; x < 48; ++x) {
                if (result.mask.at(x, y)[0] == 0.0f) continue;
                const glm::vec3 ours = again.rgb(x, y), theirs = result.radiance.rgb(x, y);
                added += double(luminance(theirs - direct.rgb(x, y)));
                difference += double(std::abs(luminance(ours - theirs)));
            }
        EXPECT_GT(added, 1.0) << use;
        EXPECT_LT(difference, 1e-3 * added) << use;
    }
};

TEST_F(IndirectTest, OnTheCamerasViewItIsWhatTheFrameGets) {
    expect_same(cornell(), "vpl:vpls=64,gather=full");
    expect_same(cornell(), "vpl:vpls=64");
    expect_same(metal_ring(), "caustic_triangles:photons=64,size=64");
    expect_same(metal_ring(), "photon_map:photons=4096");
}

TEST_F(IndirectTest, AmbientLightIsInOtherViewsToo) {
    Scene scene = shapes(ShapesLight::point);
    scene.environment.radiance = Image(8, 4, 3, 1.0f);
    FrameOptions options;
    options.environment = EnvironmentMode::ambient;
    expect_same(scene, "", options);
}

} // namespace
} // namespace luxel
