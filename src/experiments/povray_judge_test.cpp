// SPDX-License-Identifier: MIT
// POV-Ray and the path tracer see the same light: direct light, and direct light with one diffuse bounce.
#include "experiments/povray_judge.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "core/image_io.h"
#include "experiments/components.h"
#include "reference/reference.h"
#include "scene/load.h"
#include "support/build_folders.h"

namespace luxel {
namespace {

constexpr int width = 48, height = 36;

struct Ratios {
    double median, lower, upper; // quartiles of POV-Ray over the path tracer
};

Ratios compare(const Scene& scene, bool bounce, int spp, int lights) {
    const RayCaster rays(scene);
    ReferenceRequest request;
    request.components = {"direct"};
    if (bounce) request.components.push_back("diffuse1");
    request.width = width, request.height = height;
    request.camera = scene.cameras[0];
    request.settings.spp = spp;
    request.settings.pixel_center = true;
    const Estimate estimate = render_reference(rays, request);
    const Image truth = sum_of(estimate.mean, request.components);
    const Image picture = povray_radiance(scene, scene.cameras[0], width, height,
                                          {.radiosity = bounce, .specular = false, .area_lights = lights});

    std::vector<double> ratios;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const float expected = luminance(truth.rgb(x, y));
            if (*estimate.mask.at(x, y) > 0 && expected > 1e-4f)
                ratios.push_back(luminance(picture.rgb(x, y)) / expected);
        }
    std::sort(ratios.begin(), ratios.end());
    const std::size_t n = ratios.size();
    EXPECT_GT(n, std::size_t(width * height / 4));
    write_exr(std::filesystem::path(LUXEL_BINARY_DIR) / "povray_judge.exr",
              {{"povray", picture}, {"reference", truth}});
    return {ratios[n / 2], ratios[n / 4], ratios[n * 3 / 4]};
}

class PovrayJudge : public ::testing::Test {
protected:
    void SetUp() override {
        if (!povray_installed()) GTEST_SKIP() << "no povray on this machine";
    }
};

// POV-Ray stores 16-bit floats and takes 256 points for the lamp; 2 % bounds both and the reference's noise.
TEST_F(PovrayJudge, DirectLightIsTheSame) {
    for (const char* name : {"builtin:shapes-point", "builtin:shapes-directional", "builtin:cornell"}) {
        SCOPED_TRACE(name);
        const Ratios r = compare(load_scene(name), false, 256, 256);
        EXPECT_NEAR(r.median, 1.0, 0.02);
        EXPECT_NEAR(r.lower, 1.0, 0.04);
        EXPECT_NEAR(r.upper, 1.0, 0.04);
    }
}

// Radiosity interpolates between 250-ray samples, and 32 points stand for the lamp: a few percent.
TEST_F(PovrayJudge, OneBounceIsTheSameWithinInterpolation) {
    for (const char* name : {"builtin:shapes-point", "builtin:cornell"}) {
        SCOPED_TRACE(name);
        EXPECT_NEAR(compare(load_scene(name), true, 64, 32).median, 1.0, 0.04);
    }
}

} // namespace
} // namespace luxel
