// SPDX-License-Identifier: MIT
// A lamp over a plane mirror: what the mirror sends to the ceiling comes from the lamp's image, in closed
// form.
#include <functional>

#include <gtest/gtest.h>

#include "scene/procedural.h"
#include "support/gpu.h"
#include "support/mirror_scene.h"
#include "techniques/frame/renderer.h"
#include "techniques/technique.h"

namespace luxel {
namespace {

using glm::vec3;

using namespace testing;

constexpr int side = 128;

// Irradiance of the ceiling at x of light that travels along `direction`, of irradiance 1 on a plane that
// faces it.
float exact_directional(vec3 x, vec3 direction) {
    const vec3 up(direction.x, -direction.y, direction.z);
    return up.y * mirrored(x - up * (ceiling / up.y), up.y);
}

class CausticsTest : public GpuTest {
protected:
    // One technique on one scene, whose instances and lights may move between frames.
    struct Session {
        std::unique_ptr<Renderer> renderer;
        std::unique_ptr<Technique> technique;
        RenderRequest request;
        // Irradiance that the technique gives to what each pixel sees.
        Image frame() {
            Image image = renderer->render(request).images.at("caustics");
            for (float& value : image.data) value *= shared::PI / ceiling_albedo;
            return image;
        }
    };
    Session session(const Scene& scene, const std::string& use) {
        FrameOptions options;
        options.emitter_lights = 0, options.environment = EnvironmentMode::none;
        Session s{
            std::make_unique<Renderer>(gpu(), scene, options), make_technique(parse_specification(use)), {}};
        s.request = {.camera = scene.cameras.at(0),
                     .width = side,
                     .height = side,
                     .techniques = {s.technique.get()},
                     .images = {"caustics"}};
        return s;
    }
    // What mirrors show, with a technique that lights what is in them.
    Image mirrored_view(const Scene& scene, const std::string& use) {
        FrameOptions options;
        options.emitter_lights = 0, options.environment = EnvironmentMode::none;
        auto mirrors = make_technique(parse_specification("distance_map:size=256"));
        auto light = use.empty() ? nullptr : make_technique(parse_specification(use));
        RenderRequest request{.camera = scene.cameras.at(0),
                              .width = side,
                              .height = side,
                              .techniques = {mirrors.get()},
                              .images = {"distance_map reflections"}};
        if (light) request.techniques.push_back(light.get());
        return Renderer(gpu(), scene, options).render(request).images.at("distance_map reflections");
    }
    Image render(const Scene& scene, const std::string& use) { return session(scene, use).frame(); }
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
        return compare(scene, render(scene, use), [](vec3 x) { return irradiance_by_mirror(x); });
    }
    Comparison compare(const Scene& scene, const Image& image, const std::function<float(vec3)>& irradiance) {
        double ours = 0, all = 0, error = 0, count = 0;
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x) {
                const vec3 p = seen(scene, x, y);
                const float truth = irradiance(p);
                ours += image.rgb(x, y).g, all += truth;
                bool interior = true;
                for (const vec3& d :
                     {vec3(0.06f, 0, 0), vec3(-0.06f, 0, 0), vec3(0, 0, 0.06f), vec3(0, 0, -0.06f)})
                    interior = interior && irradiance(p + d) > 0.0f;
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
    const std::string flux = "caustic_triangles:photons=64,size=128,caustic_size=256,rim=flux";
    EXPECT_NEAR(compare(flux + ",area=thesis").flux / compare(flux).flux, 2.0 / 3.0, 0.01);

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
    procedural::add_quad_object(scene, procedural::lambertian("blocker", vec3(ceiling_albedo)),
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

constexpr const char* triangles_64 = "caustic_triangles:photons=64,size=128,caustic_size=256";

// Their images are parallel light; the environment is black but for a sun of one texel.
TEST_F(CausticsTest, SunAndSkyShineByWayOfTheMirror) {
    constexpr int width = 512, height = 256, column = 240, row = 28;
    Scene scene = mirror_under_ceiling({.ceiling_from = -0.2f}); // light comes in past its rim
    scene.lights.clear();
    Scene sky = scene;
    sky.environment.radiance = Image(width, height, 3);
    const float theta = shared::PI * (row + 0.5f) / height, step = shared::PI / height;
    const float phi = 2.0f * shared::PI * ((column + 0.5f) / width - 0.5f);
    const float solid = 2.0f * step * std::sin(theta) * std::sin(step / 2); // dphi (cos - cos)
    for (int c = 0; c < 3; ++c) sky.environment.radiance.at(column, row)[c] = 1.0f / solid;
    const vec3 toward(std::sin(phi) * std::sin(theta), std::cos(theta), -std::cos(phi) * std::sin(theta));
    scene.lights = {{.type = shared::LIGHT_DIRECTIONAL, .direction = -toward, .intensity = vec3(1)}};

    for (Scene* s : {&scene, &sky}) {
        const Comparison c =
            compare(*s, render(*s, triangles_64), [&](vec3 x) { return exact_directional(x, -toward); });
        EXPECT_NEAR(c.flux, 1.0, 0.05);
        EXPECT_LT(c.interior, 0.03);
    }
}

// A small square that shines downward, whose power is the lamp's as the mirror sees it.
TEST_F(CausticsTest, AnEmitterShinesByWayOfTheMirror) {
    constexpr float half = 0.01f, height = 0.8f;
    Scene scene = mirror_under_ceiling();
    scene.lights.clear();
    Material glow = procedural::lambertian("glow", vec3(0));
    glow.emission = vec3(lamp_intensity / (4 * half * half));
    procedural::add_quad_object(scene, glow, {-half, height, -half}, {2 * half, 0, 0}, {0, 0, 2 * half});
    const Comparison c = compare(scene, render(scene, triangles_64), [](vec3 x) {
        const vec3 from(0, height, 0), d = x + from;
        return irradiance_by_mirror(x, from) * d.y / glm::length(d);
    });
    EXPECT_NEAR(c.flux, 1.0, 0.05);
    EXPECT_LT(c.interior, 0.03);
}

TEST_F(CausticsTest, EverythingMayMove) {
    Scene scene = mirror_under_ceiling();
    Session moving = session(scene, triangles_64);
    const Image before = moving.frame();
    scene.lights[0].position = {0.15f, 0.7f, -0.1f};
    scene.instances[0].transform[3] = glm::vec4(-0.1f, 0.05f, 0.1f, 1.0f);
    moving.renderer->update_motion();
    const Image after = moving.frame(), anew = render(scene, triangles_64);
    EXPECT_EQ(after.data, anew.data);
    EXPECT_NE(before.data, after.data);
}

// Above the mirror and looking down, one sees the ceiling in it, and on the ceiling what the mirror lights.
TEST_F(CausticsTest, MirrorsShowCaustics) {
    Scene scene = mirror_under_ceiling();
    Camera& camera = scene.cameras[0];
    camera.position = {0, 0.6f, 0}, camera.forward = {0, -1, 0}, camera.yfov = 0.8f;
    const CameraBasis b = camera_basis(camera, side, side);
    const Image with = mirrored_view(scene, triangles_64), without = mirrored_view(scene, "");
    double ours = 0, all = 0, error = 0, count = 0;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const float found = (with.rgb(x, y).g - without.rgb(x, y).g) * shared::PI / ceiling_albedo;
            const vec3 d = pixel_direction(b, side, side, {float(x) + 0.5f, float(y) + 0.5f});
            const vec3 at = b.position - d * (b.position.y / d.y), up(d.x, -d.y, d.z);
            const float seen = mirrored(at, glm::normalize(up).y),
                        truth = seen * irradiance_by_mirror(at + up * (ceiling / up.y));
            ours += found, all += truth;
            bool interior = true;
            for (const vec3& step :
                 {vec3(0.06f, 0, 0), vec3(-0.06f, 0, 0), vec3(0, 0, 0.06f), vec3(0, 0, -0.06f)})
                interior =
                    interior && seen > 0.0f && irradiance_by_mirror(at + up * (ceiling / up.y) + step) > 0.0f;
            if (interior) error += std::abs(found - truth) / truth, ++count;
        }
    ASSERT_GT(count, 500);
    EXPECT_NEAR(ours / all, 1.0, 0.05);
    EXPECT_LT(error / count, 0.02);
}

} // namespace
} // namespace luxel
