// SPDX-License-Identifier: MIT
// Photons in image space against the reference's.
#include <gtest/gtest.h>

#include "core/metrics.h"
#include "reference/reference.h"
#include "scene/procedural.h"
#include "support/gpu.h"
#include "techniques/frame/renderer.h"

namespace luxel {
namespace {

constexpr int side = 128;

class PhotonMapAgainstReference : public testing::GpuTest {
protected:
    Estimate truth(const Scene& scene) {
        RayCaster rays(scene);
        ReferenceRequest request{
            .components = {"caustics"}, .width = side, .height = side, .camera = scene.cameras.front()};
        request.settings.spp = 12, request.settings.photons = 50000;
        return render_reference(rays, request);
    }
    Image caustics(const Scene& scene, const std::string& use) {
        FrameOptions options;
        options.emitter_lights = 0, options.environment = EnvironmentMode::none, options.shadow_size = 64;
        auto technique = make_technique(parse_specification(use));
        RenderRequest request{.camera = scene.cameras.front(),
                              .width = side,
                              .height = side,
                              .techniques = {technique.get()},
                              .images = {"caustics"}};
        const Image four = Renderer(gpu(), scene, options).render(request).images.at("caustics");
        Image rgb(side, side, 3);
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x) rgb.set_rgb(x, y, four.rgb(x, y));
        return rgb;
    }
    static double sum(const Image& image) {
        double all = 0;
        for (float v : image.data) all += v;
        return all;
    }
};

TEST_F(PhotonMapAgainstReference, MorePhotonsAreCloser) {
    for (const Scene& scene : {metal_ring(), water(0.0f), ring()}) {
        const Estimate e = truth(scene);
        const Image& theirs = e.mean.at("caustics");
        std::vector<double> errors;
        for (const char* photons : {"1024", "4096", "16384"}) {
            const Image ours = caustics(scene, std::string("photon_map:rsm_size=1024,photons=") + photons);
            errors.push_back(relmse(theirs, ours, e.mask));
            if (errors.size() == 3) {
                EXPECT_NEAR(sum(ours) / sum(theirs), 1.0, 0.05) << scene.name;
            }
        }
        EXPECT_LT(errors[1], errors[0]) << scene.name;
        EXPECT_LT(errors[2], errors[1]) << scene.name;
        EXPECT_LT(errors[2], 0.7 * errors[0]) << scene.name;
    }
}

// What the reference leaves dark in the occluded ring's room stays dark, farther from light than discs are
// wide.
TEST_F(PhotonMapAgainstReference, NothingLeaksIntoTheOccludedRing) {
    const Scene scene = occluded_ring();
    const Image theirs = truth(scene).mean.at("caustics");
    const auto dark_around = [&](int x, int y) {
        for (int v = std::max(y - 4, 0); v <= std::min(y + 4, side - 1); ++v)
            for (int u = std::max(x - 4, 0); u <= std::min(x + 4, side - 1); ++u)
                if (theirs.rgb(u, v).g > 0.0f) return false;
        return true;
    };
    const auto leaked = [&](const char* use) {
        const Image ours = caustics(scene, use);
        double dark = 0;
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x)
                if (dark_around(x, y)) dark += ours.rgb(x, y).r + ours.rgb(x, y).g + ours.rgb(x, y).b;
        return dark / sum(ours);
    };
    EXPECT_LT(leaked("photon_map"), 0.01);
    EXPECT_LT(leaked("photon_map:tracer=lines"), 0.01);
    EXPECT_LT(leaked("photon_map:tracer=layers,layers=8"), 0.01);
    EXPECT_GT(leaked("photon_map:tracer=layers,layers=4"), 0.2);
}

} // namespace
} // namespace luxel
