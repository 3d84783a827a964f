// SPDX-License-Identifier: MIT
// The surface slot held against the path tracer on the tessellated height field: direct light with its
// shadows.
#include <map>

#include <gtest/gtest.h>

#include "core/metrics.h"
#include "reference/reference.h"
#include "scene/height_field.h"
#include "scene/procedural.h"
#include "techniques/frame/renderer.h"

namespace luxel {
namespace {

constexpr int width = 192, height = 144;

class SurfaceAgainstReference : public ::testing::Test {
protected:
    static void SetUpTestSuite() {
        const Scene scene = relief(), detailed = with_height_fields(scene);
        const RayCaster rays(detailed);
        ReferenceRequest request{
            .components = {"direct"}, .width = width, .height = height, .camera = scene.cameras.front()};
        request.settings.spp = 4, request.settings.pixel_center = true;
        const Estimate truth = render_reference(rays, request);
        const float exposure = exposure_of(truth.mean.at("direct"), truth.mask);
        const Image shown = display(truth.mean.at("direct"), exposure);

        gpu::Gpu gpu({.validation = true});
        FrameOptions options;
        options.mipmaps = false;
        Renderer renderer(gpu, scene, options);
        for (const char* use :
             {"", "parallax:mode=plain", "parallax:mode=offset_limit", "parallax:mode=slope",
              "parallax:mode=iterated", "binary", "secant", "relief", "parallax_occlusion"}) {
            std::unique_ptr<Technique> technique;
            RenderRequest frame{.camera = scene.cameras.front(), .width = width, .height = height};
            if (*use) {
                technique = make_technique(parse_specification(use));
                frame.techniques = {technique.get()};
            }
            const Image image = renderer.render(frame).radiance;
            error_[use] = mean_error(shown, display(image, exposure), truth.mask);
        }
        EXPECT_TRUE(gpu.validation_messages().empty());
    }
    static inline std::map<std::string, double> error_;
};

// Mean error on display values when this was written: .186 without a technique, plain .070, slope .067,
// iterated .039, secant .032, binary .020, relief and parallax_occlusion .0145, most of it at shadows'
// borders.
TEST_F(SurfaceAgainstReference, OrdersTheTechniques) {
    EXPECT_LT(error_["parallax:mode=plain"], 0.5 * error_[""]);
    EXPECT_LT(error_["parallax:mode=offset_limit"], 0.6 * error_[""]);
    EXPECT_LT(error_["parallax:mode=slope"], error_["parallax:mode=plain"]);
    EXPECT_LT(error_["parallax:mode=iterated"], 0.7 * error_["parallax:mode=plain"]);
    EXPECT_LT(error_["secant"], error_["parallax:mode=iterated"]);
    EXPECT_LT(error_["binary"], 0.8 * error_["secant"]);
    for (const char* use : {"relief", "parallax_occlusion"}) {
        EXPECT_LT(error_[use], 0.85 * error_["binary"]) << use;
        EXPECT_LT(error_[use], 0.02) << use;
    }
}

} // namespace
} // namespace luxel
