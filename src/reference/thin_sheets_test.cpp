// SPDX-License-Identifier: MIT
// Light straight through window panes, by closed form and by all ways of sampling.
#include <gtest/gtest.h>

#include "reference/path_tracer.h"
#include "reference/test_scenes.h"
#include "shared/thin_sheet.h"

namespace luxel {
namespace {

using namespace testing;
using shared::PI;

Estimate render(const Scene& scene, const ReferenceRequest& request) {
    RayCaster rays(scene);
    return render_reference(rays, request);
}

Material pane(float ior = 1.5f, glm::vec3 tint = glm::vec3(0.9f, 0.6f, 0.3f)) {
    Material m;
    m.base_color = glm::vec4(tint, 1.0f);
    m.metallic = m.roughness = 0.0f;
    m.transmission = 1.0f;
    m.ior = ior;
    return m;
}

// A pane over the floor that its surroundings are seen below.
void add_pane(Scene& scene, const Material& material, float y, float side = 40.0f) {
    add_object(scene, material, {-side / 2, y, side / 2}, {side, 0, 0}, {0, 0, -side});
}

const Camera below = camera_on({0.4f, 0.5f, 0.3f}, {0, 0, 0});

TEST(ThinSheets, TheSunIsWeakenedByEachPaneOnItsWay) {
    const float albedo = 0.5f;
    shared::Light sun{};
    sun.type = shared::LIGHT_DIRECTIONAL, sun.intensity = glm::vec3(4.0f);
    sun.direction = glm::normalize(glm::vec3(0.8f, -1.0f, 0.3f));
    const glm::vec3 once = shared::thin_transmittance(sun.direction.y, 1.5f, glm::vec3(0.9f, 0.6f, 0.3f));
    for (int panes = 0; panes <= 2; ++panes) {
        Scene scene;
        add_floor(scene, lambertian(glm::vec3(albedo)));
        for (int i = 0; i < panes; ++i) add_pane(scene, pane(), 1.0f + 0.1f * float(i));
        scene.lights = {sun};
        const Estimate e = render(scene, request_for({"direct", "caustics"}, below, 2, 1));
        for (int c = 0; c < 3; ++c) {
            const double expected = double(albedo * 4.0f * -sun.direction.y / PI) * std::pow(once[c], panes);
            EXPECT_NEAR(measure(e, "direct", c).mean / expected, 1.0, 1e-4)
                << panes << " panes, channel " << c;
        }
        EXPECT_EQ(measure(e, "caustics").mean, 0.0) << "no photon brings it once more";
    }
}

// A sheet that is half a mirror of white light and half a pane, metals being no panes.
TEST(ThinSheets, OnlyTheTransmittingShareOfASheetLetsLightThrough) {
    Material m = pane(1.0f, glm::vec3(1.0f));
    m.transmission = 0.7f, m.metallic = 0.4f;
    Scene scene;
    add_floor(scene, lambertian(glm::vec3(1.0f)));
    add_pane(scene, m, 1.0f);
    shared::Light sun{};
    sun.type = shared::LIGHT_DIRECTIONAL, sun.intensity = glm::vec3(PI), sun.direction = {0, -1, 0};
    scene.lights = {sun};
    EXPECT_NEAR(measure(render(scene, request_for({"direct"}, below, 2, 1)), "direct").mean, 0.42, 1e-5);
}

Measured mean_of(const Scene& scene, Strategy strategy, const char* component, int seed) {
    RayCaster rays(scene);
    auto request = request_for({component}, below, 1, 1);
    request.settings.seed = seed;
    const PathTracer tracer(rays, request, {.strategy = strategy});
    double sum = 0.0, squares = 0.0;
    const int n = 60000;
    for (int s = 0; s < n; ++s) {
        const PathSample p = tracer.trace(0, 0, s);
        const double v = double((component == std::string("direct") ? p.direct : p.diffuse1).g);
        sum += v, squares += v * v;
    }
    const double mean = sum / n;
    return {mean, std::sqrt((squares / n - mean * mean) / n)};
}

// Uniform radiance 1 around, or from a lamp, seen through two panes from anywhere on the floor: the integral
// over the hemisphere in double.
TEST(ThinSheets, LampAndSkyBehindPanesAgreeWithQuadratureByEveryStrategy) {
    const float lamp_half = 0.8f, lamp_y = 2.0f;
    for (bool sky : {true, false}) {
        Scene scene;
        add_floor(scene, lambertian(glm::vec3(0.5f)));
        add_pane(scene, pane(), 0.7f, 2000.0f), add_pane(scene, pane(), 0.9f, 2000.0f);
        if (sky)
            set_uniform_environment(scene, glm::vec3(1.0f));
        else
            add_object(scene, lambertian(glm::vec3(0.0f), glm::vec3(1.0f)), {-lamp_half, lamp_y, -lamp_half},
                       {2 * lamp_half, 0, 0}, {0, 0, 2 * lamp_half});

        double expected = 0.0;
        const int n = 400;
        for (int i = 0; i < n; ++i)
            for (int j = 0; j < (sky ? 1 : n); ++j) {
                double cosine, weight; // weight: cosine x solid angle
                if (sky) {
                    const double c2 = (i + 0.5) / n;
                    cosine = std::sqrt(c2), weight = double(PI) / n;
                } else {
                    const double x = ((i + 0.5) / n * 2 - 1) * double(lamp_half),
                                 z = ((j + 0.5) / n * 2 - 1) * double(lamp_half), y = double(lamp_y),
                                 r2 = x * x + y * y + z * z, area = std::pow(2.0 * double(lamp_half) / n, 2);
                    cosine = y / std::sqrt(r2), weight = cosine * cosine * area / r2;
                }
                expected +=
                    weight *
                    std::pow(double(shared::thin_transmittance(float(cosine), 1.5f, glm::vec3(0.6f)).g), 2);
            }
        expected *= 0.5 / double(PI);
        int seed = 0;
        for (Strategy strategy : {Strategy::mis, Strategy::lights_only, Strategy::bsdf_only}) {
            const Measured m = mean_of(scene, strategy, "direct", ++seed);
            EXPECT_NEAR(m.mean, expected, z_999 * m.error + 1e-4 * expected) << sky << int(strategy);
            EXPECT_LT(m.error, (strategy == Strategy::bsdf_only ? 0.02 : 0.006) * expected)
                << sky << int(strategy);
        }
    }
}

// A clear sheet of tint .5 between two walls halves what the one sends to the other, for light that has
// bounced as for light straight from its source, and takes nothing from `diffuse` into `specular`.
TEST(ThinSheets, BouncesPassThemAsLightDoes) {
    Scene open;
    add_floor(open, lambertian(glm::vec3(0.6f)));
    add_object(open, lambertian(glm::vec3(0.9f)), {-3, 0, -4}, {6, 0, 0}, {0, 6, 0}); // lit wall
    shared::Light sun{};
    sun.type = shared::LIGHT_DIRECTIONAL, sun.intensity = glm::vec3(3.0f), sun.direction = {0, 0, -1};
    open.lights = {sun}; // grazes the floor
    Scene glazed = open;
    add_object(glazed, pane(1.0f, glm::vec3(0.5f)), {-30, 0.001f, -3.5f}, {60, 0, 0}, {0, 60, 0});

    auto request = request_for({"diffuse1", "specular", "diffuse1_unoccluded"}, below, 8, 1024);
    const Estimate a = render(open, request);
    request.settings.seed = 2;
    const Estimate b = render(glazed, request);
    const Measured whole = measure(a, "diffuse1"), part = measure(b, "diffuse1");
    EXPECT_NEAR(part.mean / whole.mean, 0.25,
                0.25 * z_999 * (whole.error / whole.mean + part.error / part.mean))
        << "once on the way to the wall, once on the way back";
    EXPECT_LT(part.error, 0.01 * part.mean);
    EXPECT_LT(measure(b, "specular").mean, 1e-6);
    EXPECT_GT(measure(b, "diffuse1_unoccluded").mean, 0.0);
}

// With light from everywhere nothing is lost or added by a sheet that absorbs nothing, whatever is photons'
// and what is not: reflected light, light through it, and light to and fro between sheets.
TEST(ThinSheets, FurnaceOfPanes) {
    Scene scene;
    add_floor(scene, lambertian(glm::vec3(0.8f)), 1.0f);
    add_pane(scene, pane(1.5f, glm::vec3(1.0f)), 0.7f, 3.0f),
        add_pane(scene, pane(1.5f, glm::vec3(1.0f)), 0.9f, 3.0f);
    set_uniform_environment(scene, glm::vec3(1.0f));
    for (PhotonLights lights : {PhotonLights::punctual, PhotonLights::all}) {
        auto request = request_for({"full"}, camera_on({0.2f, 0.3f, 0.1f}, {0, 0, 0}, 0.1f), 4, 512);
        request.settings.photon_lights = lights;
        request.settings.photons = 4000, request.settings.photon_radius = 4.0f;
        const Measured m = measure(render(scene, request), "full");
        EXPECT_NEAR(m.mean, 0.8, z_999 * m.error + 1e-4) << int(lights);
        EXPECT_LT(m.error, 0.015) << int(lights);
    }
}

} // namespace
} // namespace luxel
