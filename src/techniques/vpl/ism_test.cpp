// SPDX-License-Identifier: MIT
// Imperfect shadow maps: distances in a closed room, a plate's shadow, and none where nothing is in between.
#include "techniques/vpl/ism.h"

#include <gtest/gtest.h>

#include "scene/procedural.h"
#include "shared/sampling.h"
#include "support/gpu.h"
#include "techniques/frame/renderer.h"

namespace luxel {
namespace {

using glm::vec3, glm::vec4;

// Maps of lights that the test places.
struct IsmProbe final : Technique {
    std::vector<shared::Vpl> lights;
    IsmOptions options;
    IsmPoints points;
    IsmMaps ism;
    Slot slot() const override { return Slot::post; }
    void prepare(gpu::Gpu& gpu, const Scene& scene) override { points = ism_points(gpu, scene, options); }
    Contribution render(gpu::Recorder& recorder, const Frame& frame) override {
        std::vector<vec4> texels;
        for (const shared::Vpl& l : lights)
            texels.insert(texels.end(), {vec4(l.position, l.bound), vec4(l.normal, 0), vec4(l.flux, 0)});
        const int count = int(lights.size());
        Vpls vpls{recorder.gpu().upload(std::span<const vec4>(texels), "lights"),
                  recorder.gpu().upload(std::span<const int>(&count, 1), "count"), count};
        ism = imperfect_shadow_maps(recorder, frame, points, vpls, options);
        return {};
    }
};

class IsmTest : public testing::GpuTest {
protected:
    // Calls check(light, unit direction, 1/distance) for the texels inside of each light's hemisphere.
    template <class F> void each_texel(const Scene& scene, std::vector<shared::Vpl> lights, F check) {
        IsmProbe probe;
        probe.lights = std::move(lights), probe.options = {.size = 32, .points = 4096};
        RenderRequest request{.camera = scene.cameras.at(0), .width = 8, .height = 8, .techniques = {&probe}};
        Renderer(gpu(), scene, {.emitter_lights = 0}).render(request);
        const Image maps = gpu().read(probe.ism.maps);
        for (std::size_t i = 0; i < probe.lights.size(); ++i)
            for (int y = 0; y < 32; ++y)
                for (int x = 0; x < 32; ++x) {
                    const glm::vec2 m = (glm::vec2(x, y) + 0.5f) / 16.0f - 1.0f;
                    if (glm::length(m) > 0.9f) continue; // beside the light's own wall
                    const vec3 d = shared::frame_around(probe.lights[i].normal) * shared::from_paraboloid(m);
                    const glm::ivec2 at = shared::ism_corner(int(i), probe.ism.params) + glm::ivec2(x, y);
                    check(probe.lights[i], d, *maps.at(at.x, at.y));
                }
    }
};

float distance_in_room(vec3 from, vec3 d) {
    float nearest = 1e30f;
    for (int i = 0; i < 3; ++i) nearest = std::min(nearest, ((d[i] > 0 ? 1.0f : -1.0f) - from[i]) / d[i]);
    return nearest;
}

// Discs lie in their walls, so a texel's distance is that of its middle, but where two walls meet.
TEST_F(IsmTest, DistancesAreThoseOfTheRoom) {
    const std::vector<shared::Vpl> lights = {{vec3(0.2f, -1, 0.3f), 0.01f, vec3(0, 1, 0), vec3(1)},
                                             {vec3(-1, 0.1f, -0.4f), 0.01f, vec3(1, 0, 0), vec3(1)},
                                             {vec3(0.5f, 0.5f, 1), 0.01f, vec3(0, 0, -1), vec3(1)}};
    int texels = 0, right = 0, near = 0;
    each_texel(furnace(0.5f, 0.0f), lights, [&](const shared::Vpl& l, vec3 d, float found) {
        const float ratio = found * distance_in_room(l.position, d);
        ++texels, right += std::abs(ratio - 1.0f) < 1e-3f, near += std::abs(ratio - 1.0f) < 0.15f;
    });
    EXPECT_GT(texels, 1500);
    EXPECT_GT(right, texels * 80 / 100);
    EXPECT_GT(near, texels * 97 / 100);
}

// A floor under open sky: nothing is above it.
TEST_F(IsmTest, OpenSkyHasNoDistance) {
    Scene scene = shapes(ShapesLight::point);
    scene.instances.resize(1); // the floor
    each_texel(scene, {{vec3(0.1f, 0, 0.2f), 0.01f, vec3(0, 1, 0), vec3(1)}},
               [](const shared::Vpl&, vec3, float found) { ASSERT_EQ(found, 0.0f); });
}

// Points go where their instance goes.
TEST_F(IsmTest, PointsMoveWithTheirInstances) {
    Scene scene;
    scene.materials.emplace_back();
    scene.meshes.emplace_back();
    add_quad(scene.meshes[0], {-1, 0, -1}, {2, 0, 0}, {0, 0, 2});
    scene.instances = {{.name = "roof"}};
    scene.cameras.emplace_back();
    IsmProbe probe;
    probe.lights = {{vec3(0), 0.01f, vec3(0, 1, 0), vec3(1)}};
    Renderer renderer(gpu(), scene, {.emitter_lights = 0});
    RenderRequest request{.camera = scene.cameras.at(0), .width = 8, .height = 8, .techniques = {&probe}};
    for (float height : {1.0f, 2.0f}) {
        scene.instances[0].transform[3][1] = height;
        renderer.update_motion();
        renderer.render(request);
        const int half = probe.ism.params.size / 2;
        EXPECT_NEAR(*gpu().read(probe.ism.maps).at(half, half), 1.0f / height, 1e-3f);
    }
}

// The paraboloid covers the hemisphere, and texels have the angle that they say.
TEST(IsmMaths, ParaboloidsCoverTheHemisphere) {
    for (glm::vec2 m : {glm::vec2(0), glm::vec2(0.3f, -0.4f), glm::vec2(-0.7f, 0.7f)}) {
        const vec3 w = shared::from_paraboloid(m);
        EXPECT_NEAR(glm::length(w), 1.0f, 1e-6f);
        EXPECT_NEAR(glm::length(shared::to_paraboloid(w) - m), 0.0f, 1e-6f);
        const vec3 next = shared::from_paraboloid(m + glm::vec2(2.0f / 256.0f, 0));
        EXPECT_NEAR(glm::length(next - w) / shared::ism_texel(m, 256), 1.0f, 0.02f);
    }
}

} // namespace
} // namespace luxel
