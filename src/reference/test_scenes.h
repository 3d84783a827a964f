// SPDX-License-Identifier: MIT
// For the tests of this folder: small scenes with known answers, and the statistics to compare with them.
#pragma once
#include <cmath>
#include <string>

#include "reference/reference.h"
#include "scene/procedural.h"

namespace luxel::testing {

inline Material lambertian(glm::vec3 albedo, glm::vec3 emission = glm::vec3(0.0f)) {
    Material m;
    m.base_color = glm::vec4(albedo, 1.0f);
    m.metallic = m.specular = 0.0f;
    m.emission = emission;
    return m;
}

// Appends an object of one quad; its front normal is cross(u, v).
inline void add_object(Scene& scene, const Material& material, glm::vec3 corner, glm::vec3 u, glm::vec3 v) {
    scene.materials.push_back(material);
    Mesh mesh;
    mesh.material = int(scene.materials.size()) - 1;
    add_quad(mesh, corner, u, v);
    scene.meshes.push_back(mesh);
    Instance instance;
    instance.mesh = int(scene.meshes.size()) - 1;
    scene.instances.push_back(instance);
}

// An object of that material without triangles yet.
inline Mesh& add_mesh(Scene& scene, const Material& material) {
    add_object(scene, material, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    Mesh& mesh = scene.meshes.back();
    mesh = Mesh();
    mesh.material = int(scene.materials.size()) - 1;
    return mesh;
}

inline Material solid_glass(float ior) {
    Material m;
    m.metallic = m.roughness = 0.0f;
    m.transmission = 1.0f;
    m.thin = false;
    m.ior = ior;
    return m;
}

// A floor of `side` meters around the origin at y = 0, facing up.
inline void add_floor(Scene& scene, const Material& material, float side = 20.0f) {
    add_object(scene, material, {-side / 2, 0, side / 2}, {side, 0, 0}, {0, 0, -side});
}

inline void set_uniform_environment(Scene& scene, glm::vec3 radiance) {
    scene.environment.radiance = Image(16, 8, 3);
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 16; ++x) scene.environment.radiance.set_rgb(x, y, radiance);
}

// A camera so narrow that all its pixels see the same point.
inline Camera camera_on(glm::vec3 position, glm::vec3 target, float yfov = 1e-4f) {
    Camera c;
    c.position = position;
    c.forward = glm::normalize(target - position);
    c.up = std::abs(c.forward.y) > 0.9f ? glm::vec3(0, 0, -1) : glm::vec3(0, 1, 0);
    c.yfov = yfov;
    return c;
}

inline ReferenceRequest request_for(std::vector<std::string> components, const Camera& camera, int side,
                                    int spp) {
    ReferenceRequest r;
    r.components = std::move(components);
    r.width = r.height = side;
    r.camera = camera;
    r.settings.spp = spp;
    return r;
}

// Mean over the image of one channel, and its standard error by the run's own variance.
struct Measured {
    double mean = 0, error = 0;
};
inline Measured measure(const Estimate& estimate, const std::string& component, int channel = 0) {
    const Image &mean = estimate.mean.at(component), &variance = estimate.variance.at(component);
    Measured m;
    for (int y = 0; y < mean.height; ++y)
        for (int x = 0; x < mean.width; ++x) {
            m.mean += double(mean.at(x, y)[channel]);
            m.error += double(variance.at(x, y)[channel]);
        }
    m.mean /= double(mean.pixels());
    m.error = std::sqrt(m.error) / double(mean.pixels());
    return m;
}

inline constexpr double z_999 = 3.2905; // two-sided 99.9 % of the normal distribution

// Welch's statistic; about standard normal when both measure the same.
inline double welch(const Measured& a, const Measured& b) {
    return (a.mean - b.mean) / std::sqrt(a.error * a.error + b.error * b.error + 1e-300);
}

} // namespace luxel::testing
