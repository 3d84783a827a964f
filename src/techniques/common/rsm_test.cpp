// SPDX-License-Identifier: MIT
// Reflective shadow maps against the closed forms of their lights' flux.
#include "techniques/common/rsm.h"

#include <cmath>

#include <gtest/gtest.h>

#include "scene/procedural.h"
#include "support/gpu.h"
#include "techniques/common/rsm_params.h"
#include "techniques/frame/renderer.h"

namespace luxel {
namespace {

using glm::vec3;

// A technique that looks from the lights and adds nothing.
struct RsmProbe final : Technique {
    RsmOptions options;
    std::vector<RsmView> views;
    Slot slot() const override { return Slot::post; }
    Contribution render(gpu::Recorder& recorder, const Frame& frame) override {
        views = reflective_shadow_maps(recorder, frame, options);
        return {};
    }
};

struct Flux {
    vec3 incident{0.0f}, reflected{0.0f};
    double specular = 0.0; // share of pixels
};

class RsmTest : public testing::GpuTest {
protected:
    std::vector<RsmView> views_of(const Scene& scene, const RsmOptions& options) {
        RsmProbe probe;
        probe.options = options;
        FrameOptions frame;
        frame.emitter_lights = 0, frame.environment = EnvironmentMode::none;
        RenderRequest request{.camera = scene.cameras.at(0), .width = 8, .height = 8, .techniques = {&probe}};
        Renderer(gpu(), scene, frame).render(request);
        return probe.views;
    }
    Flux sum(const RsmView& view) {
        const Image flux = gpu().read(view.flux), reflected = gpu().read(view.reflected);
        glm::dvec3 incident(0.0), sent(0.0);
        double specular = 0.0;
        for (int y = 0; y < flux.height; ++y)
            for (int x = 0; x < flux.width; ++x) {
                incident += glm::dvec3(flux.rgb(x, y)), sent += glm::dvec3(reflected.rgb(x, y));
                specular += double(flux.at(x, y)[3]);
            }
        return {vec3(incident), vec3(sent), specular / (double(flux.width) * double(flux.height))};
    }
    Flux total(const Scene& scene, const RsmOptions& options) {
        Flux all;
        for (const RsmView& view : views_of(scene, options)) {
            Flux f = sum(view);
            all.incident += f.incident, all.reflected += f.reflected, all.specular += f.specular;
        }
        return all;
    }
};

// The closed box [-1, 1]^3, black but for its lobe of albedo (.5, .25, .125).
Scene room(const shared::Light& light) {
    Scene scene = furnace(0.5f, 0.0f);
    for (Material& m : scene.materials) m.base_color = {0.5f, 0.25f, 0.125f, 1.0f};
    scene.lights = {light};
    return scene;
}

shared::Light light_of(shared::uint type) {
    shared::Light l{};
    l.type = type, l.position = {0.2f, 0.1f, -0.3f};
    l.direction = glm::normalize(vec3(0.3f, -0.8f, 0.4f));
    l.intensity = {3.0f, 2.0f, 1.0f};
    return l;
}

void expect_flux(const Flux& f, vec3 expected, float tolerance) {
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(f.incident[c] / expected[c], 1.0f, tolerance) << c;
        EXPECT_NEAR(f.reflected[c] / (expected[c] * std::ldexp(0.5f, -c)), 1.0f, tolerance + 1e-3f) << c;
    }
}

TEST_F(RsmTest, PointLightInAClosedRoomSendsFourPiI) {
    const shared::Light l = light_of(shared::LIGHT_POINT);
    const Scene scene = room(l);
    EXPECT_EQ(views_of(scene, {.size = 64}).size(), 6u);
    expect_flux(total(scene, {.size = 128}), 4.0f * shared::PI * l.intensity, 1e-3f);
}

TEST_F(RsmTest, CosineLightSendsPiI) {
    const shared::Light l = light_of(shared::LIGHT_COSINE);
    expect_flux(total(room(l), {.size = 256}), shared::PI * l.intensity, 1e-3f);
}

// The integral of the squared fall-off over the rim's versines is a third of their range: flux = 2 pi I (inner +
// (outer - inner) / 3).
TEST_F(RsmTest, SpotSendsTheFluxOfItsCone) {
    for (float outer : {0.8f, 0.1f, shared::versine(0.5f * shared::PI / 180.0f)}) { // five faces, one view
        shared::Light l = light_of(shared::LIGHT_SPOT);
        l.outer = outer, l.inner = outer > 0.01f ? outer - 0.08f : 0.0f;
        const float cone = 2.0f * shared::PI * (l.inner + (l.outer - l.inner) / 3.0f);
        expect_flux(total(room(l), {.size = 256}), cone * l.intensity, 2e-3f);
        EXPECT_EQ(views_of(room(l), {.size = 64}).size(), outer < 0.5f ? 1u : 5u);
    }
}

// A floor of 4 m2 under slanted light covers 4 cos of the beam.
TEST_F(RsmTest, DirectionalLightSendsItsIrradianceTimesTheArea) {
    Scene scene;
    scene.materials.push_back(
        {.base_color = {0.5f, 0.25f, 0.125f, 1.0f}, .metallic = 0.0f, .specular = 0.0f});
    scene.meshes.emplace_back();
    add_quad(scene.meshes[0], {-1, 0.3f, 1}, {2, 0, 0}, {0, 0, -2});
    scene.instances.push_back({.name = "floor"});
    scene.cameras.emplace_back();
    shared::Light l = light_of(shared::LIGHT_DIRECTIONAL);
    scene.lights = {l};
    expect_flux(total(scene, {.size = 512}), 4.0f * std::abs(l.direction.y) * l.intensity, 5e-3f);

    // Positions and normals of the parallel view are those of the floor.
    const RsmView view = views_of(scene, {.size = 64}).at(0);
    const Image depth = gpu().read(view.seen.gbuffer.depth),
                normal = gpu().read(view.seen.gbuffer.geometric_normal);
    int seen = 0;
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x) {
            const float z = *depth.at(x, y);
            if (z <= 0.0f) continue;
            ++seen;
            EXPECT_NEAR(shared::world_position(view.seen.view, glm::vec2(x, y) + 0.5f, z).y, 0.3f, 1e-5f);
            EXPECT_NEAR(normal.at(x, y)[1], 1.0f, 1e-3f);
            EXPECT_EQ(normal.at(x, y)[3], 1.0f); // the front
        }
    EXPECT_GT(seen, 1000);
}

// One wall of mirror: a sixth of a cube's pixels around the middle, and no diffuse light from it.
TEST_F(RsmTest, MirrorsAreMaskedAndReflectNothingDiffusely) {
    shared::Light l = light_of(shared::LIGHT_POINT);
    l.position = vec3(0.0f);
    Scene scene;
    scene.cameras.emplace_back();
    for (int i = 0; i < 2; ++i)
        scene.materials.push_back({.base_color = glm::vec4(0.5f, 0.5f, 0.5f, 1.0f),
                                   .metallic = float(i),
                                   .roughness = i ? 0.0f : 1.0f,
                                   .specular = 0.0f});
    scene.meshes.resize(2);
    add_box(scene.meshes[0], vec3(-1), vec3(1));
    add_quad(scene.meshes[1], {0.99f, -1, -1}, {0, 0, 2}, {0, 2, 0});
    scene.meshes[1].material = 1;
    scene.instances = {{.name = "walls", .mesh = 0}, {.name = "mirror", .mesh = 1}};
    scene.lights = {l};
    const Flux f = total(scene, {.size = 128});
    EXPECT_NEAR(f.specular, 1.0, 0.05);
    EXPECT_NEAR(f.incident.x / (4.0f * shared::PI * l.intensity.x), 1.0f, 1e-3f);
    EXPECT_NEAR(f.reflected.x / f.incident.x, 0.5f * 5.0f / 6.0f, 5e-3f);
}

// Emitters and environments send light through samples of theirs, as many as asked for.
TEST_F(RsmTest, SamplesOfEmittersAreLights) {
    Scene box = cornell();
    EXPECT_EQ(views_of(box, {.size = 32, .lights = {.emitters = 0}}).size(), 0u);
    EXPECT_EQ(views_of(box, {.size = 32, .lights = {.emitters = 3}}).size(), 15u);
}

} // namespace
} // namespace luxel
