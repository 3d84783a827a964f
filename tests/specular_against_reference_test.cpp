// SPDX-License-Identifier: MIT
// Mirrors, glass and caustics of the frame against the path tracer and its photons.
#include <gtest/gtest.h>

#include "core/metrics.h"
#include "reference/reference.h"
#include "scene/procedural.h"
#include "support/gpu.h"
#include "techniques/frame/renderer.h"

namespace luxel {
namespace {

class SpecularAgainstReference : public testing::GpuTest {
protected:
    int side = 128;
    bool pixel_center = true;

    Estimate truth(const Scene& scene, const std::string& component, int spp, int depth = 4) {
        RayCaster rays(scene);
        ReferenceRequest request{
            .components = {component}, .width = side, .height = side, .camera = scene.cameras.front()};
        request.settings.spp = spp, request.settings.pixel_center = pixel_center;
        request.settings.specular_depth = depth;
        request.settings.photons = 50000;
        return render_reference(rays, request);
    }
    // What one technique adds.
    Image contribution(const Scene& scene, const std::string& use, const std::string& image) {
        FrameOptions options;
        options.emitter_lights = 0, options.environment = EnvironmentMode::none,
        options.shadow = ShadowMode::hard;
        auto technique = make_technique(parse_specification(use));
        RenderRequest request{.camera = scene.cameras.front(),
                              .width = side,
                              .height = side,
                              .techniques = {technique.get()},
                              .images = {image}};
        const Image four = Renderer(gpu(), scene, options).render(request).images.at(image);
        Image rgb(side, side, 3);
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x)
                for (int c = 0; c < 3; ++c) rgb.at(x, y)[c] = four.at(x, y)[c];
        return rgb;
    }
    // A pixel's share of wrong light, over the specular objects' pixels.
    double reflections_error(const Scene& scene, int depth, const std::string& parameters = "") {
        const Estimate e = truth(scene, "reflections", 16, depth);
        const Image ours =
            contribution(scene, "distance_map:least_weight=0.001,depth=" + std::to_string(depth) + parameters,
                         "distance_map reflections");
        const Image& theirs = e.mean.at("reflections");
        double error = 0, sum = 0;
        for (std::size_t i = 0; i < ours.data.size(); ++i)
            error += std::abs(ours.data[i] - theirs.data[i]), sum += theirs.data[i];
        EXPECT_GT(sum, 1.0);
        return error / sum;
    }
    double caustics_relmse(const Scene& scene, const Estimate& e, const std::string& use) {
        return relmse(e.mean.at("caustics"), contribution(scene, use, "caustics"), e.mask);
    }
};

TEST_F(SpecularAgainstReference, MirrorShowsThePaintedBox) {
    const double found = reflections_error(mirror_box(), 1),
                 by_direction = reflections_error(mirror_box(), 1, ",search=none");
    EXPECT_LT(found, 0.1);
    EXPECT_GT(by_direction, 3.0 * found);
}

TEST_F(SpecularAgainstReference, TeapotSeesItself) {
    for (int depth : {1, 2, 3}) EXPECT_LT(reflections_error(teapot_box(), depth), 0.16) << depth;
}

TEST_F(SpecularAgainstReference, GlassShowsTheRoom) { EXPECT_LT(reflections_error(glass_sphere(), 4), 0.1); }

TEST_F(SpecularAgainstReference, TrianglesBeatSplatsOfAnySize) {
    for (const Scene& scene : {metal_ring(), water(0.0f)}) {
        const Estimate e = truth(scene, "caustics", 12);
        const double triangles = caustics_relmse(scene, e, "caustic_triangles");
        for (const char* radius : {"6", "12", "24"})
            EXPECT_LT(triangles, caustics_relmse(scene, e, std::string("caustic_splat:radius=") + radius))
                << scene.name << " " << radius;
    }
}

// All light that arrives. Pixels of one sample each must be small for it, as the focus of the glass is.
TEST_F(SpecularAgainstReference, TrianglesKeepTheFlux) {
    side = 512, pixel_center = false;
    for (const Scene& scene : {metal_ring(), water(0.0f), glass_sphere()}) {
        const Estimate e = truth(scene, "caustics", 6);
        const Image ours = contribution(scene, "caustic_triangles", "caustics"),
                    lossy = contribution(scene, "caustic_triangles:rim=density", "caustics");
        double sum = 0, all = 0, without_rim = 0;
        for (std::size_t i = 0; i < ours.data.size(); ++i)
            sum += ours.data[i], without_rim += lossy.data[i], all += e.mean.at("caustics").data[i];
        EXPECT_NEAR(sum / all, 1.0, 0.05) << scene.name;
        EXPECT_LT(without_rim, 0.985 * sum) << scene.name;
    }
}

} // namespace
} // namespace luxel
