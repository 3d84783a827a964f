// SPDX-License-Identifier: MIT
// Light sources as bounded sets of analytic lights.
#pragma once
#include <cstdint>
#include <vector>

#include "scene/scene.h"

namespace luxel {

// An emissive triangle in world space; emission is the mean of the material's emission texture over it.
struct EmissiveTriangle {
    glm::vec3 a, b, c;
    glm::vec3 normal; // geometric, unit, the side that emits (both do when two_sided)
    glm::vec3 emission;
    float area;
    bool two_sided;
    int instance;
    std::uint32_t triangle; // index of the triangle within its mesh
};
std::vector<EmissiveTriangle> emissive_triangles(const Scene& scene);

// `count` LIGHT_COSINE samples distributed over the emissive triangles by power, stratified, deterministic
// for a seed. Their sum converges to the area light as count grows. A two-sided emitter is two one-sided
// ones. Positions are moved off the surface by a hair (1e-4 of the scene radius).
std::vector<shared::Light> emitter_sample_lights(const Scene& scene, int count, std::uint32_t seed);

// `count` directional lights drawn by importance from the environment, stratified; converges with count.
std::vector<shared::Light> environment_sample_lights(const Environment& environment, int count,
                                                     std::uint32_t seed);

// The same scene with its environment replaced by `count` directional lights.
Scene with_environment_as_lights(Scene scene, int count, std::uint32_t seed);

// Third-order (9 coefficients) real SH of the environment's radiance, no Condon-Shortley phase, in the order
// Y00, Y1-1 (y), Y10 (z), Y11 (x), Y2-2 (xy), Y2-1 (yz), Y20 (3z2-1), Y21 (xz), Y22 (x2-y2), axes as in world
// space.
std::vector<glm::vec3> project_environment_sh(const Environment& environment);

// A plain analytic sky: gradient from horizon to zenith, no sun. Stated default and test material.
Environment gradient_sky(glm::vec3 horizon, glm::vec3 zenith, glm::vec3 ground);

} // namespace luxel
