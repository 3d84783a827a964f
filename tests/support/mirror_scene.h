// SPDX-License-Identifier: MIT
// Test only: a lamp over a plane mirror under a ceiling, whose caustic is that of the lamp's image.
#pragma once
#include "scene/procedural_parts.h"
#include "shared/brdf.h"

namespace luxel::testing {

inline constexpr float half_mirror = 0.3f, ceiling = 1.5f, ceiling_albedo = 0.5f, lamp_intensity = 3.0f;
inline constexpr float mirror_f0 = 0.9f;
inline const glm::vec3 lamp(-0.1f, 1.0f, 0.05f);

// The mirror lies on y = 0, facing up, the ceiling begins at that z; the camera looks straight up at it from
// this height.
struct MirrorScene {
    float half_width = half_mirror, half_length = half_mirror;
    float ceiling_from = -2.0f;
    float camera_height = 0.9f, yfov = 2.0f;
};
inline Scene mirror_under_ceiling(const MirrorScene& m = {}) {
    Scene scene;
    scene.name = "mirror under ceiling";
    Mesh& mirror = procedural::add_specular_object(scene, procedural::mirror("mirror", glm::vec3(mirror_f0)));
    add_quad(mirror, {-m.half_width, 0, m.half_length}, {2 * m.half_width, 0, 0}, {0, 0, -2 * m.half_length});
    procedural::add_quad_object(scene, procedural::lambertian("ceiling", glm::vec3(ceiling_albedo)),
                                {-2, ceiling, m.ceiling_from}, {4, 0, 0}, {0, 0, 2 - m.ceiling_from});
    scene.lights = {procedural::point_light(lamp, lamp_intensity)};
    scene.cameras.push_back(
        {.position = {0, m.camera_height, 0}, .forward = {0, 1, 0}, .up = {0, 0, 1}, .yfov = m.yfov});
    return scene;
}

// Share that the mirror of half_mirror reflects there; 0 beside it.
inline float mirrored(glm::vec3 on_mirror, float cosine) {
    if (std::max(std::abs(on_mirror.x), std::abs(on_mirror.z)) > half_mirror) return 0.0f;
    return shared::fresnel_schlick(glm::vec3(mirror_f0), glm::vec3(1), cosine).g;
}

// Where the light for x on the ceiling meets the mirror's plane.
inline glm::vec3 on_mirror_toward(glm::vec3 x, glm::vec3 from = lamp) {
    const glm::vec3 image(from.x, -from.y, from.z), d = x - image;
    return image + d * (from.y / d.y);
}

// Irradiance of the ceiling at x by way of the mirror.
inline float irradiance_by_mirror(glm::vec3 x, glm::vec3 from = lamp) {
    const glm::vec3 d = x - glm::vec3(from.x, -from.y, from.z);
    const float cosine = d.y / glm::length(d);
    return lamp_intensity * cosine / glm::dot(d, d) * mirrored(on_mirror_toward(x, from), cosine);
}

} // namespace luxel::testing
