// SPDX-License-Identifier: MIT
// Occlusion from the depth buffer held against ray-traced occlusion of the same radius.
#include <gtest/gtest.h>

#include "reference/reference.h"
#include "scene/load.h"
#include "scene/procedural.h"
#include "support/data.h"
#include "support/gpu.h"
#include "techniques/frame/renderer.h"

namespace luxel::testing {
namespace {

constexpr int width = 128, height = 96;

class OcclusionAgainstReference : public GpuTest {
protected:
    // Mean absolute difference of accessibility to the reference of that membership, for each technique
    // and last for no occlusion at all; `tangent` is the tangent sphere's open share.
    std::vector<double> errors(const Scene& scene, float radius, const std::vector<std::string>& uses,
                               Membership membership = Membership::tangent) {
        RayCaster rays(scene);
        ReferenceRequest asked{
            .components = {"ao"}, .width = width, .height = height, .camera = scene.cameras.front()};
        asked.settings.spp = 128, asked.settings.pixel_center = true;
        asked.settings.ao_radius = radius, asked.settings.ao_membership = membership;
        Estimate truth = render_reference(rays, asked);

        FrameOptions options;
        options.emitter_lights = 1, options.shadow_size = 64, options.environment = EnvironmentMode::none;
        Renderer renderer(gpu(), scene, options);
        std::vector<double> result;
        double none = 0.0;
        for (const std::string& use : uses) {
            std::unique_ptr<Technique> technique =
                make_technique(parse_specification(use + ",radius=" + std::to_string(radius)));
            RenderRequest request{.camera = scene.cameras.front(),
                                  .width = width,
                                  .height = height,
                                  .techniques = {technique.get()},
                                  .images = {"accessibility"}};
            RenderResult frame = renderer.render(request);
            double sum = 0.0, open = 0.0, count = 0.0;
            for (int y = 0; y < height; ++y)
                for (int x = 0; x < width; ++x) {
                    if (*frame.mask.at(x, y) <= 0.0f || *truth.mask.at(x, y) <= 0.0f) continue;
                    const double expected = truth.mean.at("ao").rgb(x, y).r;
                    sum += std::abs(double(*frame.images.at("accessibility").at(x, y)) - expected);
                    open += 1.0 - expected;
                    ++count;
                }
            result.push_back(sum / count);
            none = open / count;
        }
        result.push_back(none);
        return result;
    }

    void expect_volumetric_closest(const Scene& scene, float radius) {
        std::vector<std::string> uses;
        for (const char* samples : {"8", "32"})
            for (const char* name : {"volumetric:", "containment:membership=cubic,", "containment:", "ssao:"})
                uses.push_back(std::string(name) + "samples=" + samples);
        std::vector<double> e = errors(scene, radius, uses);
        for (std::size_t i = 0; i < uses.size(); ++i) {
            std::size_t volumetric = i / 4 * 4;
            if (i == volumetric) continue;
            EXPECT_LT(e[volumetric], e[i]) << scene.name << ", radius " << radius << ", " << uses[i];
        }
    }

    // The step is what gtao estimates, and volumetric does not. hbao, whose solid angle has no cosine, has to
    // be better than nothing.
    void expect_horizons_close(const Scene& scene, float radius) {
        for (const std::string samples : {"8", "32"}) {
            SCOPED_TRACE(scene.name + ", radius " + std::to_string(radius) + ", samples " + samples);
            const std::vector<double> e = errors(
                scene, radius,
                {"volumetric:samples=" + samples, "gtao:samples=" + samples, "hbao:samples=" + samples},
                Membership::step);
            const double volumetric = e[0], gtao = e[1], hbao = e[2], none = e[3];
            EXPECT_LE(gtao, volumetric);
            EXPECT_LT(hbao, none);
        }
    }
};

TEST_F(OcclusionAgainstReference, VolumetricIsClosestToTheTangentSphere) {
    for (float radius : {0.3f, 0.9f}) {
        expect_volumetric_closest(cornell(), radius);
        expect_volumetric_closest(shapes(ShapesLight::point), radius);
    }
}

TEST_F(OcclusionAgainstReference, VolumetricIsClosestToTheTangentSphereInSponza) {
    LUXEL_DATA_OR_SKIP(file, "sponza_crytek/sponza_crytek.gltf");
    Scene scene = load_scene(file.string());
    for (float radius : {0.5f, 2.0f}) expect_volumetric_closest(scene, radius);
}

TEST_F(OcclusionAgainstReference, GtaoIsAtLeastAsCloseToTheStepAsVolumetric) {
    for (float radius : {0.3f, 0.9f}) {
        expect_horizons_close(cornell(), radius);
        expect_horizons_close(shapes(ShapesLight::point), radius);
    }
}

TEST_F(OcclusionAgainstReference, GtaoIsAtLeastAsCloseToTheStepAsVolumetricInSponza) {
    LUXEL_DATA_OR_SKIP(file, "sponza_crytek/sponza_crytek.gltf");
    Scene scene = load_scene(file.string());
    for (float radius : {0.5f, 2.0f}) expect_horizons_close(scene, radius);
}

// Half resolution is a saving, not another estimate: on smooth surfaces it is what full resolution says.
TEST_F(OcclusionAgainstReference, HalfResolutionLosesLittle) {
    std::vector<double> e =
        errors(cornell(), 0.3f, {"volumetric:samples=16", "volumetric:samples=16,resolution=half"});
    EXPECT_LT(e[1], 2.0 * e[0]);
}

} // namespace
} // namespace luxel::testing
