// SPDX-License-Identifier: MIT
// A technique's picture beside direct light's and the path tracer's, of the scene's first camera.
#pragma once
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/metrics.h"
#include "reference/reference.h"
#include "techniques/frame/renderer.h"

namespace luxel::testing {

struct PictureSetup {
    int width = 160, height = 160, spp = 128;
    EnvironmentMode environment = EnvironmentMode::none;
    std::vector<std::string> components = {"direct", "diffuse1"};
    int emitter_lights = 64;
};

struct Pictures {
    Image direct, image, mask;
    Estimate reference;
};

inline Pictures render_pictures(const Scene& scene, const PictureSetup& setup, const std::string& use) {
    gpu::Gpu gpu({.validation = true});
    FrameOptions options;
    options.shadow = ShadowMode::hard;
    options.emitter_lights = setup.emitter_lights;
    options.environment = setup.environment;
    Renderer renderer(gpu, scene, options);
    std::unique_ptr<Technique> technique = make_technique(parse_specification(use));
    RenderRequest request{.camera = scene.cameras.front(), .width = setup.width, .height = setup.height};
    Pictures p;
    p.direct = renderer.render(request).radiance;
    request.techniques = {technique.get()};
    RenderResult result = renderer.render(request);
    p.image = result.radiance, p.mask = result.mask;
    EXPECT_TRUE(gpu.validation_messages().empty());
    RayCaster rays(scene);
    ReferenceRequest truth{.components = setup.components,
                           .width = setup.width,
                           .height = setup.height,
                           .camera = scene.cameras.front()};
    truth.settings.spp = setup.spp;
    truth.settings.pixel_center = true;
    p.reference = render_reference(rays, truth);
    return p;
}

// Percent of direct light's error against direct + diffuse1 that is gone, on display values.
inline double gain_of(const Pictures& p) {
    Image truth = p.reference.mean.at("direct");
    for (std::size_t i = 0; i < truth.data.size(); ++i)
        truth.data[i] += p.reference.mean.at("diffuse1").data[i];
    float exposure = exposure_of(truth, p.reference.mask);
    Image shown = display(truth, exposure);
    return gain(mean_error(shown, display(p.direct, exposure), p.reference.mask),
                mean_error(shown, display(p.image, exposure), p.reference.mask));
}

// What the technique adds is `diffuse1`: within 2 % on average, 8 % RMS of the mean.
inline void expect_one_diffuse_bounce(const Pictures& p) {
    double bounce = 0, truth = 0, squares = 0, pixels = 0;
    const Image& diffuse1 = p.reference.mean.at("diffuse1");
    for (int y = 0; y < p.mask.height; ++y)
        for (int x = 0; x < p.mask.width; ++x) {
            if (*p.mask.at(x, y) <= 0 || *p.reference.mask.at(x, y) <= 0) continue;
            float b = luminance(p.image.rgb(x, y) - p.direct.rgb(x, y)), t = luminance(diffuse1.rgb(x, y));
            bounce += double(b), truth += double(t), squares += double(b - t) * double(b - t), ++pixels;
        }
    EXPECT_NEAR(bounce / truth, 1.0, 0.02);
    EXPECT_LT(std::sqrt(squares / pixels) / (truth / pixels), 0.08);
}

} // namespace luxel::testing
