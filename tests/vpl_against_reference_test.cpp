// SPDX-License-Identifier: MIT
// Virtual point lights held against the path tracer: without visibility they converge to the bounce that
// ignores it, and imperfect shadow maps bring them closer to the bounce that does not.
#include <cmath>

#include <gtest/gtest.h>

#include "reference/reference.h"
#include "scene/lights.h"
#include "scene/load.h"
#include "scene/procedural.h"
#include "support/data.h"
#include "techniques/frame/renderer.h"

namespace luxel {
namespace {

// One view's truth and what the technique adds to it.
class View {
public:
    View(Scene scene, int size, int spp) : scene_(std::move(scene)), size_(size) {
        scene_.environment = {};
        RayCaster rays(scene_);
        ReferenceRequest request{.components = {"diffuse1", "diffuse1_unoccluded"},
                                 .width = size,
                                 .height = size,
                                 .camera = scene_.cameras.at(0)};
        request.settings.spp = spp, request.settings.pixel_center = true;
        truth_ = render_reference(rays, request);
        FrameOptions options;
        options.emitter_lights = 0;
        renderer_ = std::make_unique<Renderer>(gpu_, scene_, options);
    }

    // Root mean square over pixels and channels, relative to the mean; the reference's variance is taken out.
    double error(const std::string& use, const std::string& component) {
        std::unique_ptr<Technique> vpl =
            make_technique(parse_specification("vpl:emitter_lights=0,rsm_size=512," + use));
        const RenderResult r = renderer_->render({.camera = scene_.cameras.at(0),
                                                  .width = size_,
                                                  .height = size_,
                                                  .techniques = {vpl.get()},
                                                  .images = {"vpl radiance"}});
        const Image &mean = truth_.mean.at(component), &variance = truth_.variance.at(component);
        double squares = 0.0, sum = 0.0, count = 0.0;
        for (int y = 0; y < size_; ++y)
            for (int x = 0; x < size_; ++x) {
                if (*r.mask.at(x, y) <= 0 || *truth_.mask.at(x, y) <= 0) continue;
                const glm::dvec3 t(mean.rgb(x, y)), d = glm::dvec3(r.images.at("vpl radiance").rgb(x, y)) - t;
                const glm::dvec3 v(variance.rgb(x, y));
                squares += glm::dot(d, d) - v.x - v.y - v.z, sum += t.x + t.y + t.z, count += 3.0;
            }
        EXPECT_GT(squares, 0.0);
        EXPECT_TRUE(gpu_.validation_messages().empty());
        return std::sqrt(squares / count) / (sum / count);
    }

private:
    gpu::Gpu gpu_{{.validation = true}};
    Scene scene_;
    int size_;
    Estimate truth_;
    std::unique_ptr<Renderer> renderer_;
};

// With one sample of the light instead of it, which both sides use. The eye is off the room's middle, where
// pixels' centers would lie on its edges.
Scene cornell_with_a_lamp() {
    Scene scene = cornell();
    scene.lights = emitter_sample_lights(scene, 1, 1);
    for (Material& m : scene.materials) m.emission = glm::vec3(0);
    scene.cameras[0].position += glm::vec3(0.0137f, 0.0071f, 0);
    return scene;
}

TEST(VplAgainstReference, ConvergesToTheBounceWithoutVisibility) {
    View view(cornell_with_a_lamp(), 48, 2048);
    for (const char* pattern : {"even", "grid"}) {
        // Least squares through log error over log count.
        double xx = 0.0, xy = 0.0, last = 0.0;
        for (int i = 0; i < 4; ++i) {
            const double x = double(i) - 1.5;
            last = view.error("vpls=" + std::to_string(64 << (2 * i)) +
                                  ",visibility=none,importance=0,pattern=" + pattern,
                              "diffuse1_unoccluded");
            xx += x * x, xy += x * std::log(last) / std::log(4.0);
        }
        EXPECT_LT(xy / xx, -0.4) << pattern;
        EXPECT_LT(last, 0.08) << pattern;
    }
}

void expect_better_with_shadow_maps(Scene scene, int size, int spp) {
    View view(std::move(scene), size, spp);
    for (const char* vpls : {"vpls=256", "vpls=1024"}) {
        const double without = view.error(std::string(vpls) + ",visibility=none", "diffuse1");
        const double with = view.error(std::string(vpls) + ",visibility=imperfect_shadow_maps", "diffuse1");
        EXPECT_LT(with, without) << vpls;
    }
}

TEST(VplAgainstReference, ImperfectShadowMapsHelpInTheCornellBox) {
    expect_better_with_shadow_maps(cornell_with_a_lamp(), 64, 128);
}

TEST(VplAgainstReference, ImperfectShadowMapsHelpInSponza) {
    LUXEL_DATA_OR_SKIP(file, "sponza_crytek/sponza_crytek.gltf");
    expect_better_with_shadow_maps(load_scene(file.string()), 48, 64);
}

} // namespace
} // namespace luxel
