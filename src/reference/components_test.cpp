// SPDX-License-Identifier: MIT
// The components add up, do not depend on each other, and the sampling strategies agree.
#include <gtest/gtest.h>

#include "core/error.h"
#include "reference/film.h"
#include "reference/path_tracer.h"
#include "reference/reference.h"
#include "reference/test_scenes.h"

namespace luxel {
namespace {

using namespace testing;

// The Cornell box with every kind of lobe and light in it.
Scene mixed_scene() {
    Scene scene = cornell();
    Material glossy;
    glossy.base_color = glm::vec4(0.7f, 0.6f, 0.5f, 1.0f);
    glossy.metallic = 0.3f;
    glossy.roughness = 0.3f;
    scene.materials[0] = glossy;
    Material mirror;
    mirror.roughness = 0.0f;
    add_object(scene, mirror, {-0.9f, 0.3f, -0.9f}, {0.8f, 0, 0.1f}, {0, 0.8f, 0});
    Material glass;
    glass.metallic = glass.roughness = 0.0f;
    glass.transmission = 0.8f;
    add_object(scene, glass, {0.2f, 0.8f, 0.4f}, {0.5f, 0, 0.1f}, {0, 0.6f, 0});
    shared::Light lamp{};
    lamp.type = shared::LIGHT_POINT;
    lamp.position = {0.3f, 1.2f, 0.6f};
    lamp.intensity = glm::vec3(0.5f);
    scene.lights.push_back(lamp);
    set_uniform_environment(scene, glm::vec3(0.2f, 0.3f, 0.5f));
    return scene;
}

// All that paths can bring.
ReferenceRequest request_for_paths(const Scene& scene, int side, int spp) {
    std::vector<std::string> names;
    for (const std::string& name : component_names)
        if (!name.ends_with("_bias")) names.push_back(name);
    ReferenceRequest request = request_for(names, scene.cameras[0], side, spp);
    request.settings.caustic_method = CausticMethod::paths;
    request.settings.photon_lights = PhotonLights::none;
    return request;
}

TEST(Components, AddUpToFull) {
    Scene scene = mixed_scene();
    RayCaster rays(scene);
    Estimate e = render_reference(rays, request_for_paths(scene, 24, 16));
    double specular = 0.0;
    for (std::size_t i = 0; i < e.mean["full"].data.size(); ++i) {
        float sum = e.mean["direct"].data[i] + e.mean["diffuse"].data[i] + e.mean["specular"].data[i];
        EXPECT_NEAR(e.mean["full"].data[i], sum, 1e-5f * std::max(1.0f, sum));
        EXPECT_LE(e.mean["diffuse1"].data[i], e.mean["diffuse"].data[i] * 1.00001f);
        EXPECT_GE(e.mean["specular"].data[i], -1e-5f);
        EXPECT_LE(e.mean["reflections"].data[i] + e.mean["caustics"].data[i],
                  e.mean["specular"].data[i] * 1.0001f + 1e-5f)
            << "they are parts of it";
        specular += double(e.mean["specular"].data[i]);
    }
    EXPECT_GT(specular, 0.0) << "the scene must exercise all components";
}

// What is left out must not change the mean of the rest.
TEST(Components, AloneAndTogetherAgree) {
    Scene scene = mixed_scene();
    RayCaster rays(scene);
    const ReferenceRequest together = request_for_paths(scene, 32, 64);
    Estimate all = render_reference(rays, together);
    for (const std::string& name : together.components) {
        auto request = together;
        request.components = {name};
        request.settings.seed = 7;
        Estimate alone = render_reference(rays, request);
        EXPECT_LT(std::abs(welch(measure(all, name), measure(alone, name))), z_999) << name;
        EXPECT_GT(measure(alone, name).mean, 0.0) << name;
    }
}

// Paths through a pixel's center share their first surface and the light of all lamps on it: the mean is that
// of paths on their own, and without area lights nothing of direct light is left to chance.
TEST(Components, PathsThroughPixelCentersShareTheirFirstSurface) {
    Scene scene = mixed_scene();
    for (int i = 0; i < 6; ++i) {
        shared::Light lamp = scene.lights[0];
        lamp.position.x = -0.8f + 0.3f * float(i);
        scene.lights.push_back(lamp);
    }
    for (bool area_lights : {true, false}) {
        if (!area_lights) {
            scene.environment = {};
            for (Material& m : scene.materials) m.emission = glm::vec3(0.0f);
        }
        RayCaster rays(scene);
        auto request = request_for({"direct", "diffuse1", "specular"}, scene.cameras[0], 16, 64);
        request.settings.pixel_center = true;
        request.settings.photon_lights = PhotonLights::none;
        const Estimate together = render_reference(rays, request);
        const PathTracer tracer(rays, request);
        Film film(16, 16, request.components);
        for (int i = 0; i < 16 * 16; ++i)
            for (int s = 0; s < 64; ++s) film.add(i % 16, i / 16, s, tracer.trace(i % 16, i / 16, s));
        const Estimate alone = film.estimate(64);
        for (const std::string& name : request.components)
            EXPECT_LT(std::abs(welch(measure(together, name), measure(alone, name))), z_999) << name;
        if (!area_lights) {
            EXPECT_EQ(measure(together, "direct").error, 0.0);
        }
    }
}

TEST(Components, OneBounceIsAllDiffuseWithOneBounce) {
    Scene scene = cornell();
    RayCaster rays(scene);
    auto request = request_for({"diffuse", "diffuse1", "direct"}, scene.cameras[0], 16, 16);
    request.settings.max_bounces = 1;
    Estimate e = render_reference(rays, request);
    EXPECT_EQ(e.mean["diffuse"].data, e.mean["diffuse1"].data);
    request.settings.max_bounces = 0;
    Estimate none = render_reference(rays, request);
    EXPECT_EQ(measure(none, "diffuse").mean, 0.0);
    EXPECT_LT(std::abs(welch(measure(none, "direct"), measure(e, "direct"))), z_999);
}

// In a convex room nothing is hidden: the bounce through everything is the bounce.
TEST(Components, UnoccludedBounceInAConvexRoom) {
    Scene scene = furnace(0.5f);
    RayCaster rays(scene);
    auto request =
        request_for({"diffuse1_unoccluded"}, camera_on({0.1f, 0.2f, 0.3f}, {0.6f, -0.5f, -1}, 1.2f), 16, 128);
    Measured m = measure(render_reference(rays, request), "diffuse1_unoccluded");
    EXPECT_NEAR(m.mean, 0.25, z_999 * m.error);
}

// A black screen hides a lit wall from the receiver, but not from the component that ignores it. The sun
// comes over the screen at 45 degrees and just meets the wall's foot, so the screen takes no light from the
// wall.
TEST(Components, UnoccludedBounceLooksThroughScreens) {
    Scene open;
    add_floor(open, lambertian(glm::vec3(0.8f)));
    add_object(open, lambertian(glm::vec3(0.5f)), {3, 0, -5}, {0, 0, 10}, {0, 5, 0}); // faces -x
    shared::Light sun{};
    sun.type = shared::LIGHT_DIRECTIONAL;
    sun.direction = glm::normalize(glm::vec3(1, -1, 0));
    sun.intensity = glm::vec3(2.0f);
    open.lights.push_back(sun);
    Scene screened = open;
    add_object(screened, lambertian(glm::vec3(0.0f)), {2, 0, -5}, {0, 0, 10}, {0, 0.999f, 0});

    auto request =
        request_for({"diffuse1", "diffuse1_unoccluded"}, camera_on({0, 2, 0}, {1.5f, 0, 0}), 16, 256);
    RayCaster rays_open(open), rays_screened(screened);
    Estimate a = render_reference(rays_open, request);
    request.settings.seed = 2;
    Estimate b = render_reference(rays_screened, request);
    EXPECT_LT(std::abs(welch(measure(a, "diffuse1"), measure(a, "diffuse1_unoccluded"))), z_999);
    EXPECT_LT(std::abs(welch(measure(a, "diffuse1_unoccluded"), measure(b, "diffuse1_unoccluded"))), z_999);
    EXPECT_LT(measure(b, "diffuse1").mean, 0.5 * measure(a, "diffuse1").mean);
}

Measured mean_of(const Scene& scene, Strategy strategy, int seed) {
    RayCaster rays(scene);
    auto request = request_for({"full"}, scene.cameras[0], 24, 1);
    request.settings.seed = seed;
    request.settings.max_bounces = 3;
    PathTracerOptions options;
    options.strategy = strategy;
    PathTracer tracer(rays, request, options);
    const int pixels = 24 * 24, spp = 256;
    double sum = 0.0, squares = 0.0;
    for (int i = 0; i < pixels; ++i)
        for (int s = 0; s < spp; ++s) {
            double v = double(tracer.trace(i % 24, i / 24, s).full().g);
            sum += v, squares += v * v;
        }
    const double n = double(pixels) * spp, mean = sum / n;
    return {mean, std::sqrt((squares / n - mean * mean) / n)};
}

TEST(Strategies, AgreeOnTheMean) {
    Scene emitter = cornell(), sky = cornell();
    emitter.materials[0].roughness = 0.4f;
    emitter.materials[0].specular = 1.0f;
    for (Material& m : sky.materials) m.emission = glm::vec3(0.0f);
    sky.environment.radiance = Image(8, 4, 3, 0.1f);
    sky.environment.radiance.set_rgb(3, 1, glm::vec3(9, 6, 3));
    for (const Scene& scene : {emitter, sky}) {
        Measured mis = mean_of(scene, Strategy::mis, 1), lights = mean_of(scene, Strategy::lights_only, 2),
                 bsdf = mean_of(scene, Strategy::bsdf_only, 3);
        EXPECT_LT(std::abs(welch(mis, lights)), z_999);
        EXPECT_LT(std::abs(welch(mis, bsdf)), z_999);
        EXPECT_LE(mis.error, 1.05 * std::min(lights.error, bsdf.error))
            << "the combination is no worse than either";
    }
}

TEST(Reference, RefusesNonsense) {
    Scene scene = cornell();
    RayCaster rays(scene);
    auto request = request_for({"direct", "glow"}, scene.cameras[0], 8, 1);
    try {
        render_reference(rays, request);
        FAIL() << "an unknown component was accepted";
    } catch (const Error& error) {
        EXPECT_EQ(error.fault(), Fault::usage);
        EXPECT_NE(std::string(error.what()).find("diffuse1_unoccluded"), std::string::npos)
            << "lists the known";
    }
    request = request_for({"direct"}, scene.cameras[0], 0, 1);
    EXPECT_THROW(render_reference(rays, request), Error);
    request = request_for({}, scene.cameras[0], 8, 1);
    EXPECT_THROW(render_reference(rays, request), Error);
}

} // namespace
} // namespace luxel
