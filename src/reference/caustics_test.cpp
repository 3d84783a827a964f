// SPDX-License-Identifier: MIT
// Caustics: closed forms, the path tracer's word, and what the run says of its own error.
#include "reference/caustics.h"

#include <filesystem>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "reference/test_scenes.h"
#include "scene/load.h"
#include "support/data.h"

namespace luxel {
namespace {

using namespace testing;
using shared::PI;

constexpr double t_999_15 = 4.073; // two-sided 99.9 % of Student's distribution with 15 degrees of freedom

Material mirror_of(glm::vec3 reflectance, float roughness = 0.0f) {
    Material m;
    m.base_color = glm::vec4(reflectance, 1.0f);
    m.roughness = roughness;
    return m;
}

shared::Light light_of(shared::uint type, glm::vec3 position, glm::vec3 direction, float intensity) {
    shared::Light l{};
    l.type = type;
    l.position = position;
    l.direction = glm::normalize(direction);
    l.intensity = glm::vec3(intensity);
    l.inner = shared::versine(0.5f);
    l.outer = shared::versine(0.8f);
    return l;
}

ReferenceRequest caustics_of(const Camera& camera, int side, int photons, int passes = 16) {
    ReferenceRequest request = request_for({"caustics"}, camera, side, passes);
    request.settings.pixel_center = true;
    request.settings.photons = photons;
    return request;
}

// Mean over the image. Neighboring pixels see the same photons, but passes are independent.
Measured mean_of_passes(const Scene& scene, const ReferenceRequest& request) {
    const RayCaster rays(scene);
    const CausticTracer tracer(rays, request);
    const double n = request.settings.spp;
    Measured m;
    double squares = 0.0;
    for (int pass = 0; pass < request.settings.spp; ++pass) {
        std::vector<double> value(std::size_t(request.width * request.height));
        tracer.trace_pass(pass, [&](int x, int y, glm::vec3 light, glm::vec3) {
            value[std::size_t(y * request.width + x)] = double(light.g);
        });
        double mean = 0.0;
        for (double v : value) mean += v / double(value.size());
        m.mean += mean / n, squares += mean * mean / n;
    }
    m.error = std::sqrt((squares - m.mean * m.mean) / (n - 1.0));
    return m;
}

// A point of a floor at y = 0 under the middle of each pixel.
double mean_over_floor(const ReferenceRequest& r, const std::function<double(glm::dvec3)>& radiance) {
    const CameraBasis basis = camera_basis(r.camera, r.width, r.height);
    double sum = 0.0;
    for (int y = 0; y < r.height; ++y)
        for (int x = 0; x < r.width; ++x) {
            const glm::vec3 d = pixel_direction(basis, r.width, r.height, {float(x) + 0.5f, float(y) + 0.5f});
            sum += radiance(glm::dvec3(basis.position + d * (-basis.position.y / d.y)));
        }
    return sum / double(r.width * r.height);
}

// Behind a plane mirror there is a second lamp: its image, dimmed by the reflectance.
TEST(Caustics, PlaneMirrorShowsAnImageOfTheLamp) {
    for (shared::uint type : {shared::LIGHT_POINT, shared::LIGHT_SPOT, shared::LIGHT_DIRECTIONAL}) {
        Scene scene;
        add_floor(scene, lambertian(glm::vec3(0.5f)));
        add_object(scene, mirror_of(glm::vec3(0.8f)), {1, 0.001f, -1}, {0, 0, 2}, {0, 2, 0}); // faces -x
        const glm::vec3 lamp(-0.5f, 1, 0);
        scene.lights = {light_of(type, lamp, glm::vec3(1, 0.8f, 0) - lamp, 3.0f)};
        const ReferenceRequest request =
            caustics_of(camera_on({0.5f, 1.5f, 0.8f}, {0.3f, 0, 0}, 0.25f), 16, 60000);

        const auto radiance = [&](glm::dvec3 p) {
            const glm::dvec3 image(2.5, 1, 0), axis = glm::dvec3(scene.lights[0].direction);
            glm::dvec3 d = image - p;
            double level = 3.0 / glm::dot(d, d);
            d = glm::normalize(d);
            if (type == shared::LIGHT_DIRECTIONAL) d = {axis.x, -axis.y, 0}, level = 3.0;
            if (type == shared::LIGHT_SPOT) {
                const double on_axis = glm::dot(glm::dvec3(d.x, -d.y, -d.z), axis); // of the mirrored ray
                const double t = (on_axis - std::cos(0.8)) / (std::cos(0.5) - std::cos(0.8));
                level *= std::pow(std::clamp(t, 0.0, 1.0), 2.0);
            }
            const double fresnel = 0.8 + 0.2 * std::pow(1.0 - d.x, 5.0);
            return 0.5 / double(PI) * level * d.y * fresnel;
        };
        const double expected = mean_over_floor(request, radiance);
        const Measured m = mean_of_passes(scene, request);
        EXPECT_NEAR(m.mean, expected, t_999_15 * m.error + 0.003 * expected) << "type " << type;
        EXPECT_LT(m.error, 0.02 * expected) << "type " << type;
    }
}

// Light passes a slab of reflectance R a side, to and fro within it, by (1 - R) / (1 + R).
TEST(Caustics, GlassLetsLightThroughByFresnel) {
    Scene scene;
    add_floor(scene, lambertian(glm::vec3(0.5f)));
    add_box(add_mesh(scene, solid_glass(1.5f)), {-0.5f, 0.4f, -0.5f}, {0.5f, 0.5f, 0.5f});
    scene.lights = {light_of(shared::LIGHT_DIRECTIONAL, {}, {0, -1, 0}, 2.0f)};
    const Measured m =
        mean_of_passes(scene, caustics_of(camera_on({1.5f, 0.3f, 0}, {0, 0, 0}, 0.1f), 16, 20000));
    const double r = 0.04, expected = 0.5 / double(PI) * 2.0 * (1.0 - r) / (1.0 + r);
    EXPECT_NEAR(m.mean, expected, t_999_15 * m.error + 1e-4);
    EXPECT_LT(m.error, 0.01 * expected);
}

// What goes straight through a thin sheet is direct light (thin_sheets_test.cpp), what it mirrors is a
// caustic: an upright pane beside the floor's middle, behind it another that only weakens the sun.
TEST(Caustics, ThinSheetsMirrorByFresnelAndWeakenWhatTheyPass) {
    Material glass = solid_glass(1.5f);
    glass.thin = true;
    Scene scene;
    add_floor(scene, lambertian(glm::vec3(0.5f)));
    add_quad(add_mesh(scene, glass), {0.5f, 0, 0.5f}, {0, 0, -1}, {0, 1, 0});
    glass.ior = 1.0f, glass.base_color = glm::vec4(0.25f);
    add_quad(add_mesh(scene, glass), {-9, 1.5f, 9}, {18, 0, 0}, {0, 0, -18});
    scene.lights = {light_of(shared::LIGHT_DIRECTIONAL, {}, {0.6f, -0.8f, 0}, 2.0f)};
    const Measured m =
        mean_of_passes(scene, caustics_of(camera_on({-1.0f, 1.4f, 0}, {0, 0, 0}, 0.1f), 16, 60000));
    const double expected =
        0.5 / double(PI) * 2.0 * 0.8 * 0.25 * double(shared::fresnel_dielectric(0.6f, 1.5f));
    EXPECT_NEAR(m.mean, expected, t_999_15 * m.error + 1e-5);
    EXPECT_LT(m.error, 0.05 * expected);
}

// A paraboloid gathers all that falls into it on a plate at its focus, less the plate's own shadow.
TEST(Caustics, ParaboloidGathersItsFluxAtTheFocus) {
    Scene scene;
    add_object(scene, lambertian(glm::vec3(1.0f)), {-0.1f, 0.5f, -0.1f}, {0.2f, 0, 0}, {0, 0, 0.2f}); // down
    std::vector<OutlinePoint> dish; // walked inward: the front faces the axis
    for (int i = 32; i >= 0; --i) {
        const float r = 0.5f * float(i) / 32.0f, slope = r; // y = r^2 / (4 f), f = .5
        const float length = std::hypot(1.0f, slope);
        dish.push_back({r, r * r / 2.0f, -slope / length, 1.0f / length});
    }
    add_revolved(add_mesh(scene, mirror_of(glm::vec3(1.0f))), glm::vec3(0.0f), dish, 96);
    scene.lights = {light_of(shared::LIGHT_DIRECTIONAL, {}, {0, -1, 0}, 2.0f)};

    // The camera looks up at the plate, which fills its image but for a margin.
    const ReferenceRequest request =
        caustics_of(camera_on({0, 0.1f, 0}, {0, 0.5f, 0}, 2.0f * std::atan(0.11f / 0.4f)), 32, 20000);
    const Measured m = mean_of_passes(scene, request);
    const double image_area = 0.22 * 0.22, flux = m.mean * double(PI) * image_area;
    const double polygon = 96.0 / 2.0 * std::sin(2.0 * double(PI) / 96.0) * 0.25; // of the tessellated rim
    const double expected = 2.0 * (polygon - 0.04);
    EXPECT_NEAR(flux / expected, 1.0, t_999_15 * m.error / m.mean + 0.01);
}

// Every kind of specular surface and of light that paths can meet. Coarse shading, so that the normals of
// reflection are not those of the triangles.
Scene path_traceable_scene() {
    Scene scene;
    add_floor(scene, lambertian(glm::vec3(0.6f)), 6.0f);
    add_sphere(add_mesh(scene, solid_glass(1.5f)), {0.6f, 0.6f, 0}, 0.4f, 16, 8);
    scene.instances.back().transform[0][0] = -1.0f; // mirrors, which must not turn its inside out
    add_sphere(add_mesh(scene, mirror_of(glm::vec3(0.9f, 0.7f, 0.5f))), {0.5f, 0.4f, 0.3f}, 0.3f, 16, 8);
    Material coated = lambertian(glm::vec3(0.5f));
    coated.specular = 1.0f;
    coated.roughness = 0.15f;
    add_object(scene, coated, {-1.5f, 0.001f, -1}, {3, 0, 0}, {0, 2, 0}); // faces +z
    add_object(scene, lambertian(glm::vec3(0.0f), glm::vec3(4.0f)), {-0.8f, 2, -0.8f}, {1.6f, 0, 0},
               {0, 0, 1.6f}); // faces down
    set_uniform_environment(scene, glm::vec3(0.3f));
    return scene;
}

TEST(Caustics, AgreeWithPaths) {
    const Scene scene = path_traceable_scene();
    const RayCaster rays(scene);
    Camera camera = camera_on({0, 1.6f, 3.0f}, {0, 0.3f, 0.3f}, 0.7f);
    auto request = caustics_of(camera, 24, 30000);
    const Measured photons = mean_of_passes(scene, request);
    request.settings.caustic_method = CausticMethod::paths;
    request.settings.spp = 512;
    const Estimate traced = render_reference(rays, request);
    EXPECT_FALSE(traced.mean.contains("caustics_bias"));
    const Measured paths = measure(traced, "caustics", 1);

    // The radius of photons leaves the mean alone but where discs hang over the edges of what the image
    // shows.
    EXPECT_NEAR(photons.mean, paths.mean,
                t_999_15 * std::hypot(photons.error, paths.error) + 0.01 * paths.mean);
    EXPECT_LT(std::hypot(photons.error, paths.error), 0.02 * paths.mean);

    // Place by place, by blocks of 4 x 4 pixels.
    request.settings.caustic_method = CausticMethod::photons;
    request.settings.spp = 16;
    const Estimate mapped = render_reference(rays, request);
    for (int by = 0; by < 24; by += 4)
        for (int bx = 0; bx < 24; bx += 4) {
            Measured a, b;
            for (int i = 0; i < 16; ++i) {
                const int x = bx + i % 4, y = by + i / 4;
                a.mean += double(traced.mean.at("caustics").rgb(x, y).g) / 16;
                b.mean += double(mapped.mean.at("caustics").rgb(x, y).g) / 16;
                a.error += double(traced.variance.at("caustics").rgb(x, y).g) / 256;
                b.error += double(mapped.variance.at("caustics").rgb(x, y).g) / 16; // as if all one
            }
            const double bound = 4.0 * std::sqrt(a.error + b.error) + 0.1 * a.mean + 0.1 * paths.mean;
            EXPECT_NEAR(b.mean, a.mean, bound) << bx << ", " << by;
        }
}

// The same on a mesh with glass within glass, in light from everywhere.
TEST(Caustics, AgreeWithPathsBehindAGlassTeapot) {
    LUXEL_DATA_OR_SKIP(file, "teapot_glass/teapot_glass.gltf");
    Scene scene = load_scene(file.string());
    scene.lights.clear();
    set_uniform_environment(scene, glm::vec3(1.0f));
    const RayCaster rays(scene);
    auto request = caustics_of(scene.cameras[0], 16, 100000); // the tea absorbs most of what it colors
    const Measured photons = mean_of_passes(scene, request);
    request.settings.caustic_method = CausticMethod::paths;
    request.settings.spp = 2048;
    const Measured paths = measure(render_reference(rays, request), "caustics", 1);
    EXPECT_NEAR(photons.mean, paths.mean,
                t_999_15 * std::hypot(photons.error, paths.error) + 0.01 * paths.mean);
    EXPECT_LT(std::hypot(photons.error, paths.error), 0.03 * paths.mean);
}

// What the run says of its radius is what a smaller one shows, and it falls with the radius.
TEST(Caustics, StateTheBiasOfTheirRadius) {
    Scene scene;
    add_floor(scene, lambertian(glm::vec3(0.6f)), 4.0f);
    add_sphere(add_mesh(scene, solid_glass(1.5f)), {0, 1.6f, 0}, 0.3f, 64,
               32); // the floor lies well behind its focus
    scene.lights = {light_of(shared::LIGHT_POINT, {0.2f, 3, 0.1f}, {0, -1, 0}, 5.0f)};
    const RayCaster rays(scene);
    auto request = caustics_of(camera_on({0, 1.2f, 2.2f}, {0, 0, 0}, 0.7f), 32, 60000, 8);
    std::vector<PhotonError> stated;
    std::vector<Image> shown;
    for (float radius : {4.0f, 2.0f, 0.7f}) {
        request.settings.photon_radius = radius;
        const Estimate e = render_reference(rays, request);
        stated.push_back(photon_error(e));
        shown.push_back(e.mean.at("caustics"));
    }
    EXPECT_LT(stated[1].bias, 0.7 * stated[0].bias);
    EXPECT_LT(stated[2].bias, 0.7 * stated[1].bias);
    EXPECT_LT(stated[0].noise, stated[1].noise);

    double squares = 0.0, levels = 0.0;
    for (int i = 0; i < 32 * 32; ++i) {
        const double d = double(luminance(shown[0].rgb(i % 32, i / 32) - shown[2].rgb(i % 32, i / 32)));
        const double level = double(luminance(shown[0].rgb(i % 32, i / 32)));
        squares += d * d, levels += level * level;
    }
    EXPECT_NEAR(stated[0].bias / std::sqrt(squares / levels), 1.0, 0.5);
}

// Over runs of different seeds pixels scatter as each run says.
TEST(Caustics, StateTheirVarianceCorrectly) {
    const Scene scene = metal_ring();
    const RayCaster rays(scene);
    auto request = caustics_of(scene.cameras[0], 12, 2000, 8);
    const int runs = 24;
    std::vector<double> sum(144), squares(144);
    double stated = 0.0, shown = 0.0;
    for (int seed = 1; seed <= runs; ++seed) {
        request.settings.seed = seed;
        const Estimate e = render_reference(rays, request);
        for (std::size_t i = 0; i < 144; ++i) {
            const double v = double(e.mean.at("caustics").data[3 * i]);
            sum[i] += v, squares[i] += v * v;
            stated += double(e.variance.at("caustics").data[3 * i]) / runs;
        }
    }
    for (std::size_t i = 0; i < 144; ++i) shown += (squares[i] - sum[i] * sum[i] / runs) / (runs - 1);

    // As many as a dozen pixels rule the sum: 3.3 standard deviations of chi-squared with 12 x 23 degrees of
    // freedom.
    EXPECT_NEAR(shown / stated, 1.0, 3.3 * std::sqrt(2.0 / (12 * 23)));
}

TEST(Caustics, RadiusShrinksAsItShould) {
    EXPECT_FLOAT_EQ(relative_photon_radius(0), 1.0f);
    for (int i : {0, 1, 9, 1000}) {
        const double now = double(relative_photon_radius(i)), next = double(relative_photon_radius(i + 1));
        EXPECT_NEAR(next * next / (now * now), (i + 1.0 + 2.0 / 3.0) / (i + 2.0), 1e-5) << i;
    }
}

// Roughness decides what counts as specular.
TEST(Caustics, OfRoughMetalCountWhenAsked) {
    Scene scene = metal_ring();
    for (Material& m : scene.materials)
        if (m.name == "ring") m.roughness = 0.3f;
    auto request = caustics_of(scene.cameras[0], 16, 5000, 2);
    EXPECT_EQ(mean_of_passes(scene, request).mean, 0.0);
    request.settings.specular_roughness = 0.3f;
    EXPECT_GT(mean_of_passes(scene, request).mean, 0.0);
}

void expect_identical(const Estimate& a, const Estimate& b) {
    for (const char* name : {"caustics", "caustics_bias"}) {
        EXPECT_EQ(a.mean.at(name).data, b.mean.at(name).data) << name;
        EXPECT_EQ(a.variance.at(name).data, b.variance.at(name).data) << name;
    }
}

TEST(Caustics, AreTheSameForAnyThreadCountAndAfterResuming) {
    const Scene scene = glass_sphere();
    const RayCaster rays(scene);
    auto request = caustics_of(scene.cameras[0], 24, 5000, 9);
    request.components = {"direct", "caustics"};
    const Estimate straight = render_reference(rays, request);
    for (std::size_t threads : {1u, 3u}) {
        tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        expect_identical(straight, render_reference(rays, request));
    }
    request.checkpoint = std::filesystem::path(::testing::TempDir()) / "caustics.luxel";
    std::filesystem::remove(request.checkpoint);
    for (int spp : {4, 9}) {
        request.settings.spp = spp;
        const Estimate part = render_reference(rays, request);
        EXPECT_TRUE(part.warnings.empty());
        if (spp == 9) expect_identical(straight, part);
    }
    request.settings.photons = 6000;
    EXPECT_EQ(render_reference(rays, request).warnings.size(), 1u)
        << "another number of photons is another run";
    std::filesystem::remove(request.checkpoint);
    request.checkpoint.clear();
    request.settings.seed = 2;
    EXPECT_NE(straight.mean.at("caustics").data, render_reference(rays, request).mean.at("caustics").data);
}

TEST(Caustics, AreBlackWithoutMirrorsGlassOrLight) {
    const Scene diffuse = cornell();
    EXPECT_EQ(mean_of_passes(diffuse, caustics_of(diffuse.cameras[0], 8, 1000, 2)).mean, 0.0);
    Scene dark = glass_sphere();
    dark.lights.clear();
    EXPECT_EQ(mean_of_passes(dark, caustics_of(dark.cameras[0], 8, 1000, 2)).mean, 0.0);
}

} // namespace
} // namespace luxel
