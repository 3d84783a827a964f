// SPDX-License-Identifier: MIT
// A lamp over a plane mirror: what the mirror sends to the ceiling comes from the lamp's image, in closed
// form.
#include <gtest/gtest.h>

#include "scene/procedural.h"
#include "scene/procedural_parts.h"
#include "shared/brdf.h"
#include "support/gpu.h"
#include "techniques/frame/renderer.h"
#include "techniques/technique.h"

namespace luxel {
namespace {

using glm::vec3;

constexpr int side = 128;
constexpr float half_mirror = 0.3f, ceiling = 1.5f, albedo = 0.5f, intensity = 3.0f;
const vec3 lamp(-0.1f, 1.0f, 0.05f);

// The mirror lies on y = 0, facing up; the camera looks straight up at the ceiling.
Scene mirror_under_ceiling() {
    Scene scene;
    scene.name = "mirror under ceiling";
    Mesh& mirror = procedural::add_specular_object(scene, procedural::mirror("mirror", vec3(0.9f)));
    add_quad(mirror, {-half_mirror, 0, half_mirror}, {2 * half_mirror, 0, 0}, {0, 0, -2 * half_mirror});
    procedural::add_quad_object(scene, procedural::lambertian("ceiling", vec3(albedo)), {-2, ceiling, -2},
                                {4, 0, 0}, {0, 0, 4});
    scene.lights = {procedural::point_light(lamp, intensity)};
    scene.cameras.push_back({.position = {0, 0.9f, 0}, .forward = {0, 1, 0}, .up = {0, 0, 1}, .yfov = 2.0f});
    return scene;
}

// Irradiance of the ceiling at x by way of the mirror.
float exact(vec3 x) {
    const vec3 image(lamp.x, -lamp.y, lamp.z), d = x - image;
    const vec3 on_mirror = image + d * (lamp.y / d.y);
    if (std::max(std::abs(on_mirror.x), std::abs(on_mirror.z)) > half_mirror) return 0.0f;
    const float cosine = d.y / glm::length(d);
    return intensity * cosine / glm::dot(d, d) * shared::fresnel_schlick(vec3(0.9f), vec3(1), cosine).g;
}

class CausticsTest : public testing::GpuTest {
protected:
    // Irradiance that a technique gives to what each pixel sees.
    Image render(const Scene& scene, const std::string& use) {
        FrameOptions options;
        options.emitter_lights = 0, options.environment = EnvironmentMode::none;
        auto technique = make_technique(parse_specification(use));
        RenderRequest request{.camera = scene.cameras.at(0),
                              .width = side,
                              .height = side,
                              .techniques = {technique.get()},
                              .images = {"caustics"}};
        Image image = Renderer(gpu(), scene, options).render(request).images.at("caustics");
        for (float& value : image.data) value *= shared::PI / albedo;
        return image;
    }
    vec3 seen(const Scene& scene, int x, int y) {
        const CameraBasis b = camera_basis(scene.cameras[0], side, side);
        const vec3 d = pixel_direction(b, side, side, {float(x) + 0.5f, float(y) + 0.5f});
        return b.position + d * ((ceiling - b.position.y) / d.y);
    }
    struct Comparison {
        double flux;     // over the exact one
        double interior; // mean relative error away from the outline
    };
    Comparison compare(const std::string& use) {
        const Scene scene = mirror_under_ceiling();
        const Image image = render(scene, use);
        double ours = 0, all = 0, error = 0, count = 0;
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x) {
                const vec3 p = seen(scene, x, y);
                const float truth = exact(p);
                ours += image.rgb(x, y).g, all += truth;
                bool interior = true;
                for (const vec3& d :
                     {vec3(0.06f, 0, 0), vec3(-0.06f, 0, 0), vec3(0, 0, 0.06f), vec3(0, 0, -0.06f)})
                    interior = interior && exact(p + d) > 0.0f;
                if (interior) error += std::abs(image.rgb(x, y).g - truth) / truth, ++count;
            }
        EXPECT_GT(count, 500);
        return {ours / all, error / count};
    }
};

TEST_F(CausticsTest, PlaneMirrorLightsTheCeilingLikeTheLampsImage) {
    const Comparison triangles = compare("caustic_triangles:photons=64,size=128,caustic_size=256");
    EXPECT_NEAR(triangles.flux, 1.0, 0.05);
    EXPECT_LT(triangles.interior, 0.02);

    // Half of the areas instead of a third keeps two thirds of the light.
    const Comparison thesis = compare("caustic_triangles:photons=64,size=128,caustic_size=256,area=thesis");
    EXPECT_NEAR(thesis.flux / triangles.flux, 2.0 / 3.0, 0.01);

    // Splats keep it as well; small ones show their dots.
    for (const char* radius : {"1.5", "3", "6"}) {
        const Comparison splats =
            compare(std::string("caustic_splat:photons=64,size=128,caustic_size=256,radius=") + radius);
        EXPECT_NEAR(splats.flux, 1.0, 0.08) << radius;
        if (std::string(radius) == "1.5") {
            EXPECT_GT(splats.interior, 3.0 * triangles.interior);
        }
    }
}

TEST_F(CausticsTest, ABlockerKeepsItsShadow) {
    Scene scene = mirror_under_ceiling();
    const Image open = render(scene, "caustic_triangles:photons=64,size=128,caustic_size=256");
    procedural::add_quad_object(scene, procedural::lambertian("blocker", vec3(albedo)),
                                {-0.12f, 0.3f, -0.12f}, {0.24f, 0, 0}, {0, 0, 0.24f});
    const Image blocked = render(scene, "caustic_triangles:photons=64,size=128,caustic_size=256");
    double shadow = 0, before = 0, lit = 0, lit_before = 0;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const vec3 p = seen(scene, x, y), image(lamp.x, -lamp.y, lamp.z);
            const vec3 d = p - image, at = image + d * ((0.3f + lamp.y) / d.y);
            const float inside = 0.12f - std::max(std::abs(at.x), std::abs(at.z));
            // The blocker shades the mirror, too: its shadow there is dark all the same.
            if (inside > 0.03f) shadow += blocked.rgb(x, y).g, before += open.rgb(x, y).g;
            const vec3 on_mirror = image + d * (lamp.y / d.y), down = lamp + (on_mirror - lamp) * 0.7f;
            const vec3 from_center =
                p * (0.3f / ceiling); // what the blocker hides from the mirror's middle gets nothing
            if (inside < -0.05f && std::max(std::abs(down.x), std::abs(down.z)) > 0.17f &&
                std::max(std::abs(from_center.x), std::abs(from_center.z)) > 0.16f)
                lit += blocked.rgb(x, y).g, lit_before += open.rgb(x, y).g;
        }
    ASSERT_GT(before, 10.0);
    EXPECT_LT(shadow, 0.01 * before);
    EXPECT_NEAR(lit / lit_before, 1.0, 0.06);
}

} // namespace
} // namespace luxel
