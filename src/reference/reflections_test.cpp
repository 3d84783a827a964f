// SPDX-License-Identifier: MIT
// Reflections to a depth: closed forms.
#include <gtest/gtest.h>

#include "reference/reference.h"
#include "reference/test_scenes.h"
#include "shared/brdf.h"

namespace luxel {
namespace {

using namespace testing;

Material mirror_of(float reflectance) {
    Material m;
    m.base_color = glm::vec4(glm::vec3(reflectance), 1.0f);
    m.roughness = 0.0f;
    return m;
}

Measured reflections(const Scene& scene, const Camera& camera, int depth, int spp = 16) {
    RayCaster rays(scene);
    auto request = request_for({"reflections"}, camera, 8, spp);
    request.settings.specular_depth = depth;
    return measure(render_reference(rays, request), "reflections");
}

// A mirror shows what direct light holds for the floor that it mirrors, by its Fresnel reflectance.
TEST(Reflections, OfALitFloorInAMirror) {
    Scene scene;
    add_floor(scene, lambertian(glm::vec3(0.6f)));
    add_object(scene, mirror_of(0.8f), {2, 0, -5}, {0, 0, 10}, {0, 5, 0}); // faces -x
    shared::Light sun{};
    sun.type = shared::LIGHT_DIRECTIONAL;
    sun.direction = glm::normalize(glm::vec3(0.3f, -1, 0.2f));
    sun.intensity = glm::vec3(3.0f);
    scene.lights.push_back(sun);
    const glm::vec3 eye(0, 2, 0), target(2, 1.5f, 0);
    const float cosine = glm::normalize(target - eye).x;
    const float fresnel = shared::fresnel_schlick(glm::vec3(0.8f), glm::vec3(1.0f), cosine).r;
    const float expected = 0.6f / shared::PI * 3.0f * -sun.direction.y * fresnel;
    for (int depth : {1, 2, 8})
        EXPECT_NEAR(reflections(scene, camera_on(eye, target), depth).mean, expected, 1e-4f * expected);
}

// Mirrors that emit: each further reflection of one in the other adds the next power of their reflectance.
TEST(Reflections, BetweenParallelMirrorsAreAGeometricSeries) {
    Scene scene;
    Material lamp = mirror_of(0.7f);
    lamp.emission = glm::vec3(2.0f);
    add_object(scene, lamp, {-1, -50, 50}, {0, 0, -100}, {0, 100, 0}); // faces +x
    add_object(scene, lamp, {1, -50, -50}, {0, 0, 100}, {0, 100, 0});  // faces -x
    double expected = 0.0;
    for (int depth = 1; depth <= 5; ++depth) {
        expected += 2.0 * std::pow(0.7, depth);
        const Measured m = reflections(scene, camera_on({0, 0, 0}, {1, 0.1f, 0.05f}), depth, 256);
        EXPECT_NEAR(m.mean, expected, z_999 * m.error + 1e-4) << depth; // the roulette makes noise
    }
}

// A solid slab seen along its normal in surroundings of radiance 1: one vertex reflects R, two let (1 - R)^2
// through, each further one adds what has gone to and fro once more.
TEST(Reflections, GlassSlabByNumberOfSurfaces) {
    Scene scene;
    Material glass;
    glass.metallic = glass.roughness = 0.0f;
    glass.transmission = 1.0f;
    glass.thin = false;
    add_floor(scene, glass);
    scene.meshes[0] = Mesh();
    add_box(scene.meshes[0], {-5, -5, -0.1f}, {5, 5, 0.1f});
    set_uniform_environment(scene, glm::vec3(1.0f));
    const double r = 0.04;
    double expected = r;
    for (int depth = 1; depth <= 4; ++depth) {
        if (depth > 1) expected += (1.0 - r) * (1.0 - r) * std::pow(r, depth - 2);
        const Measured m = reflections(scene, camera_on({0, 0, 4}, {0, 0, 0}), depth, 1024);
        EXPECT_NEAR(m.mean, expected, z_999 * m.error + 1e-4) << depth;
    }
}

// Of a polished metal, light that its lobe throws straight to the eye is direct; what else it shows is not.
TEST(Reflections, OfNearlyIdealMetalsAreSplitFromDirectLight) {
    Scene scene;
    Material metal = mirror_of(0.9f);
    metal.roughness = 0.1f;
    add_floor(scene, metal);
    set_uniform_environment(scene, glm::vec3(1.0f));
    const Camera camera = camera_on({2, 1.2f, 0}, {0, 0, 0});
    EXPECT_EQ(reflections(scene, camera, 8).mean, 0.0) << "the environment is a light";

    // In a closed box of radiance 1 nothing of the lobe is straight from a light but the emission of the
    // walls.
    Scene box = furnace(0.5f);
    add_object(box, metal, {-0.2f, -0.5f, 0.2f}, {0.4f, 0, 0}, {0, 0, -0.4f});
    RayCaster rays(box);
    auto request = request_for({"reflections", "specular"}, camera_on({0.3f, 0, 0}, {0, -0.5f, 0}), 8, 256);
    const Estimate e = render_reference(rays, request);
    const double lobe = 0.9; // about its albedo
    const Measured m = measure(e, "reflections");
    EXPECT_NEAR(m.mean, lobe * 0.5, 0.03) << "the walls' reflected share of direct light";
    request.settings.specular_roughness = 0.05f;
    EXPECT_EQ(measure(render_reference(rays, request), "reflections").mean, 0.0) << "too rough to count";
}

} // namespace
} // namespace luxel
