// SPDX-License-Identifier: MIT
// `full` with the photons of what paths cannot find: closed forms, the word of paths where they see all, and
// what the run says of its own error.
#include <filesystem>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "reference/photon_tracer.h"
#include "reference/test_scenes.h"
#include "scene/load.h"

namespace luxel {
namespace {

using namespace testing;
using shared::PI;

constexpr double t_99_3 = 5.841; // two-sided 99 % of Student's distribution with 3 degrees of freedom

Material perfect_mirror() {
    Material m;
    m.roughness = 0.0f;
    return m;
}

// Mean over the image and its error by the groups of samples: photons are common to the pixels, so that their
// variances do not add.
Measured image_mean(const Estimate& e, const std::string& component) {
    Measured m;
    double squares = 0.0;
    for (const Layers& group : e.group) {
        double mean = 0.0;
        const Image& image = group.at(component);
        for (int i = 0; i < e.width * e.height; ++i)
            mean += double(image.rgb(i % e.width, i / e.width).g) / double(e.width * e.height);
        m.mean += mean / sample_groups, squares += mean * mean / sample_groups;
    }
    m.error = std::sqrt(std::max(squares - m.mean * m.mean, 0.0) / (sample_groups - 1));
    return m;
}

ReferenceRequest full_of(const Camera& camera, int side, int photons, int spp, PhotonLights lights) {
    ReferenceRequest request = request_for({"full"}, camera, side, spp);
    request.settings.photons = photons;
    request.settings.photon_lights = lights;
    return request;
}

// A hemisphere of albedo .5 over a perfect mirror is, unfolded, a sphere around two lamps. Light that a
// sphere's wall reflects spreads over it evenly, however it fell: only the first irradiance depends on the
// place.
TEST(PhotonPaths, KeepTheEnergyOfAClosedRoomWithAMirror) {
    Scene scene;
    std::vector<OutlinePoint> dome;
    for (int j = 0; j <= 64; ++j) {
        const float theta = PI / 2.0f * float(j) / 64.0f, s = j == 0 ? 0.0f : std::sin(theta),
                    c = std::cos(theta);
        dome.push_back({s, j == 64 ? 0.0f : c, -s, -c});
    }
    add_revolved(add_mesh(scene, lambertian(glm::vec3(0.5f))), glm::vec3(0.0f), dome, 256);
    Mesh& floor = add_mesh(scene, perfect_mirror());
    for (int i = 0; i < 20 * 20; ++i) // small quads, as photons are drawn by triangles
        add_quad(floor, {-1.1f + 0.11f * float(i % 20), 0, 1.1f - 0.11f * float(i / 20)}, {0.11f, 0, 0},
                 {0, 0, -0.11f});
    shared::Light lamp{};
    lamp.type = shared::LIGHT_POINT;
    lamp.position = {0, 0.3f, 0};
    lamp.intensity = glm::vec3(1.0f);
    scene.lights = {lamp};

    const RayCaster rays(scene);
    const glm::vec3 eye(-0.2f, 0.4f, -0.1f), wall = glm::normalize(glm::vec3(0.5f, 0.6f, 0.6f));
    const glm::vec3 in_mirror = wall * glm::vec3(1, -1, 1);
    double first = 0.0;
    for (const float height : {0.3f, -0.3f}) {
        const glm::vec3 to_lamp = glm::vec3(0, height, 0) - wall;
        first += double(glm::dot(-wall, glm::normalize(to_lamp)) / glm::dot(to_lamp, to_lamp));
    }
    const double expected = 0.5 / double(PI) * (first + 0.5 / (1.0 - 0.5) * 2.0);
    for (const glm::vec3 target : {wall, in_mirror}) {
        const Camera camera = camera_on(eye, target, 0.02f);
        ReferenceRequest request = full_of(camera, 6, 20000, 32, PhotonLights::punctual);
        request.settings.photon_radius = 12.0f;
        const Measured full = image_mean(render_reference(rays, request), "full");
        EXPECT_LT(full.error, 0.02 * expected);
        EXPECT_NEAR(full.mean, expected, t_99_3 * full.error + 2e-3 * expected) << "the polyhedron's error";
        request.settings.photon_lights = PhotonLights::none;
        EXPECT_LT(image_mean(render_reference(rays, request), "full").mean, 0.8 * expected)
            << "paths cannot see the lamp in the mirror";
    }
}

// Cornell's box with a glass ball and a mirror: paths find its lamp through both.
TEST(PhotonPaths, AgreeWithPathsWhereThoseSeeAll) {
    Scene scene = cornell();
    add_sphere(add_mesh(scene, solid_glass(1.5f)), {0.35f, 0.85f, 0.3f}, 0.25f, 64, 32);
    add_object(scene, perfect_mirror(), {-0.99f, 0.3f, -0.5f}, {0, 1.2f, 0}, {0, 0, 1.2f});
    const RayCaster rays(scene);
    const Estimate paths = render_reference(rays, full_of(scene.cameras[0], 16, 1, 512, PhotonLights::none));
    const Estimate photons =
        render_reference(rays, full_of(scene.cameras[0], 16, 20000, 64, PhotonLights::all));
    EXPECT_FALSE(paths.mean.contains("photon_bias"));
    const Measured a = image_mean(paths, "full"), b = image_mean(photons, "full");
    const Measured bias = image_mean(photons, "photon_bias");
    EXPECT_NEAR(a.mean, b.mean - bias.mean, t_99_3 * std::hypot(a.error, b.error)) << "bias " << bias.mean;
    EXPECT_LT(std::hypot(a.error, b.error), 0.02 * a.mean);
}

// In a room that shines everywhere, the light of its walls by photons is what it is by paths.
TEST(PhotonPaths, KeepAFurnaceAsItIs) {
    Scene scene = furnace(0.5f);
    add_sphere(add_mesh(scene, perfect_mirror()), {0.2f, -0.3f, -0.4f}, 0.35f, 64, 32);
    const RayCaster rays(scene);
    const Estimate e = render_reference(rays, full_of(scene.cameras[0], 12, 20000, 48, PhotonLights::all));
    const Measured full = image_mean(e, "full"), bias = image_mean(e, "photon_bias");
    EXPECT_GT(image_mean(e, "full").mean, 1.5);
    EXPECT_NEAR(full.mean - bias.mean, 2.0, t_99_3 * full.error + 0.01 * 2.0);
}

// A lamp's reflection in a mirror makes a highlight on a glossy floor, which no other lobe than the glossy
// one sees: it is that of a second lamp behind the mirror.
TEST(PhotonPaths, ReachGlossySurfaces) {
    Scene scene;
    Material glossy = lambertian(glm::vec3(0.0f));
    glossy.specular = 1.0f, glossy.roughness = 0.4f;
    add_floor(scene, glossy, 4.0f);
    add_object(scene, perfect_mirror(), {-2, 0, -1}, {4, 0, 0}, {0, 4, 0});
    shared::Light lamp{};
    lamp.type = shared::LIGHT_POINT;
    lamp.position = {0, 1, 0};
    lamp.intensity = glm::vec3(1.0f);
    scene.lights = {lamp};
    const Camera camera = camera_on({0, 1, 1.5f}, {0, 0, 0.2f}, 0.05f);
    ReferenceRequest request = full_of(camera, 4, 60000, 16, PhotonLights::punctual);
    request.settings.photon_radius = 4.0f;
    const Estimate e = render_reference(RayCaster(scene), request);

    Scene unfolded;
    add_floor(unfolded, glossy, 4.0f);
    shared::Light behind = lamp;
    behind.position.z = -2.0f;
    unfolded.lights = {behind};
    const Estimate truth =
        render_reference(RayCaster(unfolded), full_of(camera, 4, 1, 4, PhotonLights::none));
    const Measured photons = image_mean(e, "full"), alone = image_mean(truth, "full");
    const Measured lit =
        image_mean(render_reference(RayCaster(scene), full_of(camera, 4, 1, 4, PhotonLights::none)), "full");
    EXPECT_NEAR(photons.mean - lit.mean, alone.mean, t_99_3 * photons.error + 0.02 * alone.mean);
    EXPECT_LT(photons.error, 0.05 * alone.mean);
}

TEST(PhotonPaths, StateTheBiasOfTheirRadius) {
    Scene scene;
    add_floor(scene, lambertian(glm::vec3(0.6f)), 4.0f);
    add_sphere(add_mesh(scene, solid_glass(1.5f)), {0, 1.6f, 0}, 0.3f, 64, 32);
    shared::Light lamp{};
    lamp.type = shared::LIGHT_POINT;
    lamp.position = {0.2f, 3, 0.1f};
    lamp.intensity = glm::vec3(5.0f);
    scene.lights = {lamp};
    const RayCaster rays(scene);
    ReferenceRequest request =
        full_of(camera_on({0, 1.2f, 2.2f}, {0, 0, 0}, 0.7f), 32, 40000, 16, PhotonLights::punctual);
    std::vector<PhotonError> stated;
    for (float radius : {3.0f, 1.0f}) {
        request.settings.photon_radius = radius;
        stated.push_back(photon_error(render_reference(rays, request), "full"));
    }
    EXPECT_LT(stated[1].bias, 0.7 * stated[0].bias);
    EXPECT_GT(stated[0].bias, 0.0);
    EXPECT_LT(stated[0].noise, stated[1].noise);
}

TEST(PhotonPaths, AreTheSameForAnyThreadCountAndAfterResuming) {
    const Scene scene = glass_metal();
    const RayCaster rays(scene);
    ReferenceRequest request = full_of(scene.cameras[0], 16, 3000, 19, PhotonLights::punctual);
    request.components = {"full", "caustics"};
    const auto expect_identical = [](const Estimate& a, const Estimate& b) {
        for (const char* name : {"full", "photon_bias", "caustics"}) {
            EXPECT_EQ(a.mean.at(name).data, b.mean.at(name).data) << name;
            EXPECT_EQ(a.variance.at(name).data, b.variance.at(name).data) << name;
        }
    };
    const Estimate straight = render_reference(rays, request);
    EXPECT_TRUE(straight.warnings.empty());
    {
        tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
        expect_identical(straight, render_reference(rays, request));
    }
    request.checkpoint = std::filesystem::path(::testing::TempDir()) / "photon_paths.luxel";
    std::filesystem::remove(request.checkpoint);
    for (int spp : {11, 19}) {
        request.settings.spp = spp;
        const Estimate part = render_reference(rays, request);
        if (spp == 19) expect_identical(straight, part);
    }
    request.settings.photon_lights = PhotonLights::all;
    EXPECT_EQ(render_reference(rays, request).warnings.size(), 1u) << "other photons are another run";
    std::filesystem::remove(request.checkpoint);
}

TEST(PhotonPaths, AreLeftOutWherePathsSeeAll) {
    const auto layers = [](const Scene& scene, PhotonLights lights) {
        return render_reference(RayCaster(scene), full_of(scene.cameras[0], 4, 100, 8, lights)).mean.size();
    };
    EXPECT_EQ(layers(cornell(), PhotonLights::all), 1u) << "nothing is specular";
    EXPECT_EQ(layers(shapes(ShapesLight::point), PhotonLights::punctual), 1u);
    EXPECT_EQ(layers(glass_sphere(), PhotonLights::none), 1u);
    EXPECT_EQ(layers(glass_sphere(), PhotonLights::punctual), 2u) << "full and photon_bias";
    const Scene few = glass_sphere();
    EXPECT_EQ(render_reference(RayCaster(few), full_of(few.cameras[0], 4, 100, 7, PhotonLights::punctual))
                  .warnings.size(),
              1u)
        << "seven runs are too few for a variance";
}

// Photons of every scene that was made for them end on something.
TEST(PhotonPaths, MeetSomethingInTheScenesForThem) {
    for (const char* name :
         {"ring", "occluded-ring", "bunnies-ring", "water-room", "water-room-1.5", "pool"}) {
        const Scene scene = load_scene(std::string("builtin:") + name);
        const RayCaster rays(scene);
        ReferenceSettings settings;
        settings.photons = 4000;
        const PhotonTracer tracer(rays, settings, {-1.0f, true, 1u, [](const Surface& surface) {
                                                       return surface.brdf.diffuse != glm::vec3(0.0f);
                                                   }});
        EXPECT_GT(tracer.trace(0).size(), 2000u) << name;
    }
}

} // namespace
} // namespace luxel
