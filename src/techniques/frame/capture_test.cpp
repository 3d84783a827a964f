// SPDX-License-Identifier: MIT
// Captures of the scene from other views and behind what one sees.
#include <gtest/gtest.h>

#include "scene/procedural.h"
#include "support/gpu.h"
#include "techniques/frame/projection.h"
#include "techniques/frame/renderer.h"

namespace luxel {
namespace {

using Capturing = std::function<void(gpu::Recorder&, const Frame&)>;

// A technique that captures and adds nothing.
class Probe final : public Technique {
public:
    explicit Probe(Capturing capture) : capture_(std::move(capture)) {}
    Slot slot() const override { return Slot::post; }
    Contribution render(gpu::Recorder& recorder, const Frame& frame) override {
        capture_(recorder, frame);
        return {};
    }

private:
    Capturing capture_;
};

class CaptureTest : public testing::GpuTest {
protected:
    RenderResult probe(const Scene& scene, Capturing capture, std::vector<std::string> images) {
        FrameOptions options;
        options.emitter_lights = 1;
        Probe technique(std::move(capture));
        RenderRequest request{.camera = scene.cameras.at(0),
                              .width = 64,
                              .height = 48,
                              .techniques = {&technique},
                              .images = std::move(images)};
        return Renderer(gpu(), scene, options).render(request);
    }
};

// Single-sided quads before one another, 1 m wide, across the view down -z: front sides at 2, 3 and 4 m, the
// one at 3 m turned away from the camera. A point light stands at the eye.
Scene stack(bool double_sided) {
    Scene scene;
    scene.name = "stack";
    for (int i = 0; i < 3; ++i) {
        Material m;
        m.metallic = 0.0f, m.specular = 0.0f, m.double_sided = double_sided;
        m.base_color = glm::vec4(glm::vec3(0.25f * float(i + 1)), 1.0f);
        scene.materials.push_back(m);
        Mesh mesh;
        float z = -float(2 + i);
        if (i == 1)
            add_quad(mesh, {-5, -5, z}, {0, 10, 0}, {10, 0, 0});
        else
            add_quad(mesh, {-5, -5, z}, {10, 0, 0}, {0, 10, 0});
        mesh.material = i;
        scene.meshes.push_back(mesh);
        scene.instances.push_back({.name = "quad", .mesh = i});
    }
    shared::Light light{};
    light.type = shared::LIGHT_POINT, light.position = {0, 0, 0.5f}, light.intensity = glm::vec3(1);
    scene.lights.push_back(light);
    Camera camera;
    camera.position = {0, 0, 0};
    scene.cameras.push_back(camera);
    return scene;
}

void expect_all(const Image& image, float value) {
    for (float v : image.data) ASSERT_NEAR(v, value, 1e-4f);
}

TEST_F(CaptureTest, OfTheFramesOwnViewIsTheFrame) {
    RenderResult r = probe(shapes(ShapesLight::spot),
                           [](gpu::Recorder& recorder, const Frame& frame) {
                               frame.capture(recorder, {.view = frame.view, .prefix = "probe "});
                           },
                           {"depth", "normal", "direct", "direct_diffuse", "probe depth", "probe normal",
                            "probe direct", "probe direct_diffuse"});
    for (const char* name : {"depth", "normal", "direct", "direct_diffuse"})
        EXPECT_EQ(r.images.at(name).data, r.images.at(std::string("probe ") + name).data) << name;
}

TEST_F(CaptureTest, OfAnotherViewIsThatViewsFrame) {
    Scene scene = shapes(ShapesLight::point);
    Camera aside = scene.cameras[0];
    aside.position += glm::vec3(0.4f, 0.2f, -0.1f);
    RenderResult captured =
        probe(scene,
              [&](gpu::Recorder& recorder, const Frame& frame) {
                  frame.capture(recorder, {.view = view_params(aside, 64, 48), .prefix = "probe "});
              },
              {"probe depth", "probe direct"});
    scene.cameras[0] = aside;
    RenderResult moved = probe(scene, [](gpu::Recorder&, const Frame&) {}, {"depth", "direct"});
    EXPECT_EQ(captured.images.at("probe depth").data, moved.images.at("depth").data);
    EXPECT_EQ(captured.images.at("probe direct").data, moved.images.at("direct").data);
}

// Peels twice behind the visible surface.
void peel_twice(gpu::Recorder& recorder, const Frame& frame) {
    Capture second = frame.capture(
        recorder, {.view = frame.view, .prefix = "second ", .farther_than = frame.gbuffer.depth});
    frame.capture(recorder, {.view = frame.view, .prefix = "third ", .farther_than = second.gbuffer.depth});
}

TEST_F(CaptureTest, BehindWhatIsSeenLeavesOutTheBacksOfSolids) {
    RenderResult r =
        probe(stack(false), peel_twice, {"depth", "second depth", "second diffuse", "third depth"});
    expect_all(r.images.at("depth"), 2.0f);
    expect_all(r.images.at("second depth"), 4.0f); // not 3, which shows its back
    EXPECT_NEAR(r.images.at("second diffuse").at(32, 24)[0], 0.75f, 1e-3f);
    expect_all(r.images.at("third depth"), 0.0f);
}

TEST_F(CaptureTest, DoubleSidedSurfacesHaveNoBack) {
    RenderResult r = probe(stack(true), peel_twice, {"second depth", "third depth", "second direct_diffuse"});
    expect_all(r.images.at("second depth"), 3.0f);
    expect_all(r.images.at("third depth"), 4.0f);
    expect_all(r.images.at("second direct_diffuse"), 0.0f); // in the first quad's shadow
}

} // namespace
} // namespace luxel
