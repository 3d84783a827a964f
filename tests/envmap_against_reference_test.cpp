// SPDX-License-Identifier: MIT
// Diffuse environment mapping held against the path tracer's bounce without occlusion.
#include <cmath>

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include "scene/load.h"
#include "scene/procedural.h"
#include "support/data.h"
#include "support/glowing_room.h"
#include "support/reference_pictures.h"

namespace luxel {
namespace {

using namespace testing;

constexpr int size = 96;

// One view of a scene: what techniques add to it, and a component of the reference.
class View {
public:
    View(Scene s, std::size_t camera, const std::string& component = "diffuse1_unoccluded")
        : scene_(std::move(s)), gpu_({.validation = true}),
          renderer_(gpu_, scene_, options()), request_{.camera = scene_.cameras.at(camera),
                                                       .width = size,
                                                       .height = size,
                                                       .images = {"envmap radiance"}} {
        RayCaster rays(scene_);
        ReferenceRequest truth{
            .components = {component}, .width = size, .height = size, .camera = request_.camera};
        truth.settings.spp = 48, truth.settings.pixel_center = true;
        truth_ = render_reference(rays, truth).mean.at(component);
    }

    // RMS error on the object over the mean of what it should be; over blocks of 8x8 pixels that lie on the
    // object, since they leave little of the reference's noise.
    double error(const std::string& use) {
        std::unique_ptr<Technique> technique = make_technique(parse_specification(use));
        request_.techniques = {technique.get()};
        const Image light = renderer_.render(request_).images.at("envmap radiance");
        EXPECT_TRUE(gpu_.validation_messages().empty());
        constexpr int block = 8;
        double squares = 0, sum = 0, blocks = 0;
        for (int y = 0; y < size; y += block)
            for (int x = 0; x < size; x += block) {
                double found = 0, expected = 0, pixels = 0;
                for (int i = 0; i < block * block; ++i) {
                    const int u = x + i % block, v = y + i / block;
                    pixels += double(light.at(u, v)[3]); // 1 on the object
                    found += double(luminance(light.rgb(u, v))),
                        expected += double(luminance(truth_.rgb(u, v)));
                }
                if (pixels < block * block) continue;
                found /= pixels, expected /= pixels;
                squares += (found - expected) * (found - expected), sum += expected, ++blocks;
            }
        EXPECT_GT(blocks, 8.0);
        return std::sqrt(squares / blocks) / (sum / blocks);
    }

private:
    static FrameOptions options() {
        FrameOptions o;
        o.shadow = ShadowMode::hard, o.shadow_size = 512;
        return o;
    }
    Scene scene_;
    gpu::Gpu gpu_;
    Renderer renderer_;
    RenderRequest request_;
    Image truth_;
};

TEST(EnvmapAgainstReference, PolygonsStayBoundedOnTheWayToTheWalls) {
    // At a fiftieth of the ball's size the wall before it lies in its shadow, whose border only fine polygons
    // follow.
    for (BallPlace place : {BallPlace::face, BallPlace::edge, BallPlace::corner})
        for (float distance : {1.0f, 0.2f, 0.02f}) {
            View view(ball_room(place, distance, BallLight::lamps), 1);
            const double polygon = view.error("envmap"), fine = view.error("envmap:texels=8");
            EXPECT_LT(polygon, distance < 0.1f ? 0.18 : 0.04) << int(place) << " " << distance;
            EXPECT_LT(fine, distance < 0.1f ? 0.06 : 0.02) << int(place) << " " << distance;
            if (distance == 1.0f) continue;
            EXPECT_LT(1.5 * polygon, view.error("envmap:estimator=point"));
            EXPECT_LT(2.0 * polygon, view.error("envmap:estimator=classic"));
        }
}

// The room with the bunny where the ball was, as large; dark, so that it hardly lights itself.
Scene bunny_room(const Scene& bunny, float distance, BallPlace place = BallPlace::face,
                 BallLight light = BallLight::lamps) {
    Scene scene = ball_room(place, distance, light);
    Bounds ball, model = bunny.bounds();
    for (glm::vec3 p : scene.meshes[6].positions) ball.add(p);
    const float scale = (ball.most.x - ball.least.x) / (model.most.x - model.least.x);
    scene.meshes[6] = bunny.meshes.at(0), scene.meshes[6].material = 6;
    scene.materials[6].base_color = glm::vec4(0.1f, 0.1f, 0.1f, 1.0f);
    scene.instances[6].transform =
        glm::translate(glm::mat4(1.0f), ball.center()) * glm::scale(glm::mat4(1.0f), glm::vec3(scale)) *
        glm::translate(glm::mat4(1.0f), -model.center()) * bunny.instances.at(0).transform;
    return scene;
}

// A metal ball between walls that glow: the path tracer's light on it is what its lobe reflects of them.
TEST(EnvmapAgainstReference, GlossyBallReflectsTheWalls) {
    for (const float roughness : {0.3f, 0.6f}) {
        Scene scene = ball_room(BallPlace::face, 1.0f, BallLight::walls);
        Material& ball = scene.materials.at(6);
        ball.base_color = glm::vec4(0.9f, 0.9f, 0.9f, 1.0f), ball.metallic = 1.0f, ball.roughness = roughness;
        View view(std::move(scene), 1, "direct");
        const double glossy = view.error("envmap:light=all,glossy=on,estimator=classic"),
                     without = view.error("envmap:light=all,estimator=classic");
        EXPECT_LT(glossy, 0.06) << roughness;
        EXPECT_GT(without, 0.9) << roughness;
    }
}

TEST(EnvmapAgainstReference, LightsTheBunny) {
    LUXEL_DATA_OR_SKIP(file, "models/stanford_bunny/stanford_bunny.gltf");
    const Scene bunny = load_scene(file.string());
    for (float distance : {1.0f, 0.02f}) {
        View view(bunny_room(bunny, distance), 1);
        EXPECT_LT(view.error("envmap:texels=8"), 0.04) << distance;
    }
}

// Without shadows on the walls: the closed form of walls that glow. Where points have no bound, polygons do.
TEST(EnvmapAgainstClosedForm, PolygonsStayBoundedOnTheBunnyAndPointsDoNot) {
    LUXEL_DATA_OR_SKIP(file, "models/stanford_bunny/stanford_bunny.gltf");
    const Scene bunny = load_scene(file.string());
    gpu::Gpu gpu({.validation = true});
    FrameOptions options;
    options.emitter_lights = 0, options.environment = EnvironmentMode::none;
    Errors polygon, point;
    for (BallPlace place : {BallPlace::face, BallPlace::edge, BallPlace::corner})
        for (float distance : {1.0f, 0.2f, 0.02f}) {
            const Scene scene = bunny_room(bunny, distance, place, BallLight::walls);
            Renderer renderer(gpu, scene, options);
            auto run = [&](const std::string& use, Errors& worst) {
                auto technique = make_technique(parse_specification(use));
                const RenderResult result =
                    renderer.render({.camera = scene.cameras.at(1),
                                     .width = size,
                                     .height = size,
                                     .techniques = {technique.get()},
                                     .images = {"envmap radiance", "depth", "normal"}});
                const Errors e = errors_in_glowing_room(scene, result, 1);
                worst.rms = std::max(worst.rms, e.rms), worst.most = std::max(worst.most, e.most);
            };
            run("envmap:light=all", polygon);
            run("envmap:light=all,estimator=point", point);
        }
    EXPECT_LT(polygon.rms, 0.03);
    EXPECT_GT(point.rms, 10 * polygon.rms);
    EXPECT_GT(point.most, 10 * polygon.most);
}

} // namespace
} // namespace luxel
