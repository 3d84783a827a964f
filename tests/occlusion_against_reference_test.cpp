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
    // Mean absolute difference of accessibility to the tangent sphere's open share, for each technique.
    std::vector<double> errors(const Scene& scene, float radius, const std::vector<std::string>& uses) {
        RayCaster rays(scene);
        ReferenceRequest asked{
            .components = {"ao"}, .width = width, .height = height, .camera = scene.cameras.front()};
        asked.settings.spp = 128, asked.settings.pixel_center = true;
        asked.settings.ao_radius = radius, asked.settings.ao_membership = Membership::tangent;
        Estimate truth = render_reference(rays, asked);

        FrameOptions options;
        options.emitter_lights = 1, options.shadow_size = 64, options.environment = EnvironmentMode::none;
        Renderer renderer(gpu(), scene, options);
        std::vector<double> result;
        for (const std::string& use : uses) {
            std::unique_ptr<Technique> technique =
                make_technique(parse_specification(use + ",radius=" + std::to_string(radius)));
            RenderRequest request{.camera = scene.cameras.front(),
                                  .width = width,
                                  .height = height,
                                  .techniques = {technique.get()},
                                  .images = {"accessibility"}};
            RenderResult frame = renderer.render(request);
            double sum = 0.0, count = 0.0;
            for (int y = 0; y < height; ++y)
                for (int x = 0; x < width; ++x) {
                    if (*frame.mask.at(x, y) <= 0.0f || *truth.mask.at(x, y) <= 0.0f) continue;
                    sum += std::abs(double(*frame.images.at("accessibility").at(x, y)) -
                                    double(truth.mean.at("ao").rgb(x, y).r));
                    ++count;
                }
            result.push_back(sum / count);
        }
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

// Half resolution is a saving, not another estimate: on smooth surfaces it is what full resolution says.
TEST_F(OcclusionAgainstReference, HalfResolutionLosesLittle) {
    std::vector<double> e =
        errors(cornell(), 0.3f, {"volumetric:samples=16", "volumetric:samples=16,resolution=half"});
    EXPECT_LT(e[1], 2.0 * e[0]);
}

} // namespace
} // namespace luxel::testing
