// SPDX-License-Identifier: MIT
// Virtual point lights: what they send together, where they stand, and that the list is compact.
#include "techniques/common/vpl.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "scene/procedural.h"
#include "support/gpu.h"
#include "techniques/frame/renderer.h"

namespace luxel {
namespace {

using glm::vec3, glm::vec4;

struct VplProbe final : Technique {
    RsmOptions rsm;
    VplOptions options;
    std::vector<RsmView> views;
    Vpls vpls;
    Slot slot() const override { return Slot::post; }
    Contribution render(gpu::Recorder& recorder, const Frame& frame) override {
        views = reflective_shadow_maps(recorder, frame, rsm);
        vpls = sample_vpls(recorder, views, options);
        return {};
    }
};

class VplTest : public testing::GpuTest {
protected:
    VplProbe probe(const Scene& scene, const VplOptions& options, int rsm_size = 256) {
        VplProbe p;
        p.rsm.size = rsm_size, p.options = options;
        FrameOptions frame;
        frame.emitter_lights = 0, frame.environment = EnvironmentMode::none;
        RenderRequest request{.camera = scene.cameras.at(0), .width = 8, .height = 8, .techniques = {&p}};
        Renderer(gpu(), scene, frame).render(request);
        return p;
    }
    std::vector<shared::Vpl> read(const Vpls& vpls) {
        const int count = gpu().read_all<int>(vpls.count).at(0);
        const std::vector<vec4> t = gpu().read_all<vec4>(vpls.lights);
        std::vector<shared::Vpl> out;
        for (std::size_t i = 0; i < std::size_t(count); ++i)
            out.push_back({vec3(t[3 * i]), t[3 * i].w, vec3(t[3 * i + 1]), vec3(t[3 * i + 2])});
        return out;
    }
    vec3 reflected(const std::vector<RsmView>& views) {
        glm::dvec3 sum(0.0);
        for (const RsmView& view : views) {
            const Image image = gpu().read(view.reflected);
            for (int y = 0; y < image.height; ++y)
                for (int x = 0; x < image.width; ++x) sum += glm::dvec3(image.rgb(x, y));
        }
        return vec3(sum);
    }
};

vec3 flux_of(const std::vector<shared::Vpl>& vpls) {
    glm::dvec3 sum(0.0);
    for (const shared::Vpl& v : vpls) sum += glm::dvec3(v.flux);
    return vec3(sum);
}

// The lights of every kind of view send what their reflective shadow maps reflect.
TEST_F(VplTest, TogetherTheySendTheReflectedFlux) {
    Scene scenes[] = {shapes(ShapesLight::point), shapes(ShapesLight::spot), shapes(ShapesLight::directional),
                      cornell()};
    for (VplPattern pattern : {VplPattern::even, VplPattern::grid})
        for (const Scene& scene : scenes) {
            const VplProbe p = probe(scene, {.count = 4096, .pattern = pattern});
            const vec3 sum = flux_of(read(p.vpls)), truth = reflected(p.views);
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(sum[c] / truth[c], 1.0f, 0.02f) << scene.name << int(pattern);
        }
}

// Lights stand on surfaces and face the side that is lit; the areas that they stand for add up to a floor.
TEST_F(VplTest, TheyStandOnLitSurfaces) {
    Scene scene = furnace(0.5f, 0.0f);
    shared::Light lamp{};
    lamp.position = {0.3f, -0.2f, 0.1f}, lamp.intensity = vec3(1.0f);
    scene.lights = {lamp};
    const std::vector<shared::Vpl> vpls = read(probe(scene, {.count = 512}).vpls);
    EXPECT_NEAR(double(vpls.size()), 512.0, 6.0);
    double area = 0.0;
    for (const shared::Vpl& v : vpls) {
        const vec3 m = glm::abs(v.position);
        EXPECT_NEAR(std::max({m.x, m.y, m.z}), 1.0f, 1e-4f);
        EXPECT_GT(glm::dot(lamp.position - v.position, v.normal), 0.0f);
        area += double(v.bound * shared::PI);
    }
    EXPECT_NEAR(area / 24.0, 1.0, 0.03); // m2 of six walls
}

// What is dark is left out, without a gap: half of a floor is black, and above it is nothing.
TEST_F(VplTest, TheListHoldsWhatSendsLight) {
    Scene scene;
    scene.cameras.emplace_back();
    for (float albedo : {0.5f, 0.0f}) {
        scene.materials.push_back(
            {.base_color = glm::vec4(vec3(albedo), 1.0f), .metallic = 0.0f, .specular = 0.0f});
        Mesh mesh;
        add_quad(mesh, {albedo > 0.0f ? -1.0f : 0.0f, 0, 1}, {1, 0, 0}, {0, 0, -2});
        mesh.material = int(scene.meshes.size());
        scene.meshes.push_back(mesh);
        scene.instances.push_back({.name = "half", .mesh = mesh.material});
    }
    shared::Light lamp{};
    lamp.position = {0, 0.5f, 0}, lamp.intensity = vec3(1.0f);
    scene.lights = {lamp};
    const VplProbe p = probe(scene, {.count = 1200});
    const std::vector<shared::Vpl> vpls = read(p.vpls);
    EXPECT_GT(vpls.size(), 200u);
    EXPECT_LT(vpls.size(), 500u);
    for (const shared::Vpl& v : vpls) EXPECT_GT(v.flux.x, 0.0f);
    for (const shared::Vpl& v : vpls) EXPECT_LT(v.position.x, 0.01f);
}

// Without a light there is none.
TEST_F(VplTest, NoLightNoVpl) {
    Scene scene = furnace(0.5f, 0.0f);
    EXPECT_TRUE(read(probe(scene, {}).vpls).empty());
}

// A grid has a point in each cell, the even pattern one in each row and each column; the disc's have its mean
// radius, 2/3.
TEST(VplPatterns, FillTheirDomain) {
    constexpr int n = 8;
    std::vector<int> cells(n * n), rows(n * n);
    double radius = 0.0;
    for (int i = 0; i < n * n; ++i) {
        const glm::vec2 g = shared::vpl_unit_point(i, n * n, shared::VPL_GRID, {}, {0.3f, 0.9f});
        ++cells[std::size_t(int(g.y * n) * n + int(g.x * n))];
        const glm::vec2 e = shared::vpl_unit_point(i, n * n, shared::VPL_EVEN, {0.0f, 0.5f}, {});
        ++rows[std::size_t(e.y * float(n * n))];
        radius += double(glm::length(shared::vpl_image_point(e, true) - 0.5f)) * 2.0 / (n * n);
    }
    EXPECT_EQ(cells, std::vector<int>(n * n, 1));
    EXPECT_EQ(rows, std::vector<int>(n * n, 1));
    EXPECT_NEAR(radius, 2.0 / 3.0, 0.01);
}

} // namespace
} // namespace luxel
