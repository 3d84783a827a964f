// SPDX-License-Identifier: MIT
// Kept shadow maps give the picture of maps that are drawn anew, and are drawn anew when what they show
// moves.
#include "techniques/frame/shadow_cache.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "scene/procedural.h"
#include "techniques/frame/renderer.h"

namespace luxel {
namespace {

class ShadowCacheTest : public ::testing::Test {
protected:
    void TearDown() override {
        for (const std::string& message : gpu.validation_messages()) ADD_FAILURE() << message;
    }
    static RenderRequest request(const Scene& scene) {
        return {.camera = scene.cameras.at(0), .width = 96, .height = 72};
    }
    gpu::Gpu gpu{{.validation = true}};
};

bool draws_shadows(const RenderResult& frame) {
    return std::any_of(frame.passes.begin(), frame.passes.end(),
                       [](const gpu::PassTime& p) { return p.name.starts_with("shadow:"); });
}

Camera moved(Camera camera) {
    camera.position += glm::vec3(0.1f, 0.05f, 0.0f);
    return camera;
}

TEST_F(ShadowCacheTest, AStillSceneDrawsItsMapsOnce) {
    for (const ShadowMode mode : {ShadowMode::hard, ShadowMode::pcf, ShadowMode::esm}) {
        const Scene scene = cornell();
        const FrameOptions options{.shadow = mode, .shadow_size = 512, .emitter_lights = 16};
        Renderer renderer(gpu, scene, options);
        const RenderResult first = renderer.render(request(scene)), second = renderer.render(request(scene));
        EXPECT_TRUE(draws_shadows(first));
        EXPECT_FALSE(draws_shadows(second));
        EXPECT_EQ(first.radiance.data, second.radiance.data);
    }
}

// 40 lights of 5 faces make several batches, of which a budget of 1 MiB holds none.
TEST_F(ShadowCacheTest, ASmallBudgetGivesTheSamePicture) {
    const Scene scene = cornell();
    FrameOptions options{.shadow_size = 1024, .emitter_lights = 40};
    Renderer kept(gpu, scene, options);
    options.shadow_memory = 0;
    Renderer anew(gpu, scene, options);
    kept.render(request(scene)), anew.render(request(scene));
    const RenderResult a = kept.render(request(scene)), b = anew.render(request(scene));
    EXPECT_FALSE(draws_shadows(a));
    EXPECT_TRUE(draws_shadows(b));
    EXPECT_EQ(a.radiance.data, b.radiance.data);
}

TEST_F(ShadowCacheTest, OnlyDirectionalLightsFollowTheCamera) {
    for (const ShapesLight light : {ShapesLight::point, ShapesLight::spot, ShapesLight::directional}) {
        const Scene scene = shapes(light);
        const FrameOptions options{.shadow_size = 512};
        RenderRequest aside = request(scene);
        aside.camera = moved(aside.camera);
        Renderer renderer(gpu, scene, options), fresh(gpu, scene, options);
        renderer.render(request(scene));
        const RenderResult second = renderer.render(aside);
        EXPECT_EQ(draws_shadows(second), light == ShapesLight::directional);
        EXPECT_EQ(second.radiance.data, fresh.render(aside).radiance.data);
    }
}

TEST_F(ShadowCacheTest, MovedObjectsAndLightsAreDrawnAnew) {
    Scene scene = shapes(ShapesLight::point);
    const FrameOptions options{.shadow_size = 512};
    Renderer renderer(gpu, scene, options);
    renderer.render(request(scene));
    renderer.update_motion(); // nothing has moved
    EXPECT_FALSE(draws_shadows(renderer.render(request(scene))));

    scene.instances.back().transform[3] += glm::vec4(0.2f, 0.1f, 0.0f, 0.0f);
    renderer.update_motion();
    const RenderResult object = renderer.render(request(scene));
    EXPECT_TRUE(draws_shadows(object));
    EXPECT_EQ(object.radiance.data, Renderer(gpu, scene, options).render(request(scene)).radiance.data);

    scene.lights.at(0).position += glm::vec3(0.3f, 0.0f, 0.1f);
    renderer.update_motion();
    const RenderResult lamp = renderer.render(request(scene));
    EXPECT_TRUE(draws_shadows(lamp));
    EXPECT_EQ(lamp.radiance.data, Renderer(gpu, scene, options).render(request(scene)).radiance.data);
}

} // namespace
} // namespace luxel
