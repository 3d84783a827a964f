// SPDX-License-Identifier: MIT
// What a ray finds at a hit: geometry and the material's textures, looked up bilinearly at mip 0.
#pragma once
#include "scene/raycast.h"
#include "scene/scene.h"
#include "scene/shading_mesh.h"
#include "shared/brdf.h"

namespace luxel {

struct Surface {
    glm::vec3 position;         // world; on the triangle, a few clearances inside its edges
    float offset;               // meters along the geometric normal that clear all rounding of `position`
    glm::vec3 geometric_normal; // unit, by winding (not flipped)
    glm::vec3 normal; // unit shading normal incl. normal map; on the ray's side it is shared::bent_normal, so
                      // it lies in the hemispheres of geometric_normal and of the ray's origin
    const Material* material;
    // Toward the ray's origin, scaled by 1 - transmission.
    shared::Brdf brdf;
    float coverage;        // share of the light that meets the surface: alpha where it is blended, else 1
    shared::Brdf coat;     // KHR_materials_clearcoat's own lobe; all that is below it has been weakened by it
    glm::vec3 coat_normal; // as `normal`, without the normal map of what is below
    bool has_coat() const { return coat.f90.x > 0.0f; }
    float metallic, roughness;
    float transmission; // share of the surface that is a dielectric light passes through, metals excluded
    float glass_gain;   // on what that share reflects and lets through: below a coat, or spread by facets
    float specular;     // KHR_materials_specular, textures included
    glm::vec3 specular_color;
    glm::vec3 base_color; // linear, texture x factor x vertex color
    glm::vec3 emission;   // radiance of the front side (of both sides if double_sided)
    bool front;           // the ray came from the side that geometric_normal points to
};

// direction: of the ray that hit.
Surface surface_at(const Scene& scene, const Hit& hit, glm::vec3 direction);

// Hints that surface_at() will be asked for these hits: call the first for many hits, then the second, then
// look the surfaces up, and what they wait for from memory arrives for all at once. (The first loads, for the
// prefetch of RayCaster::intersect() alone was measured to gain little: the address misses the TLB too.)
void load_triangle(const Hit& hit);
void prefetch_texels(const Scene& scene, const Hit& hit);

// Radiance that leaves the front of a triangle at barycentric (u, v).
glm::vec3 emission_at(const Scene& scene, std::uint32_t instance, std::uint32_t triangle, glm::vec2 uv);

// Share of the light that meets the surface at barycentric (u, v): 0 or 1 by an alpha mask, alpha where it is
// blended.
float coverage_at(const Scene& scene, std::uint32_t instance, std::uint32_t triangle, glm::vec2 uv);
// Whether nothing at all meets it.
bool is_transparent(const Scene& scene, std::uint32_t instance, std::uint32_t triangle, glm::vec2 uv);

// RGBA in [0, 1], linear (srgb textures decoded). Texel (0, 0) is the top left; uv (0, 0) is its corner.
glm::vec4 sample_texture(const Texture& texture, glm::vec2 uv);

// Outside this distance from a triangle whose largest vertex coordinate is `magnitude`, rounding cannot put a
// ray's origin on the wrong side of it.
inline float clearance(float magnitude) {
    return magnitude * 3.8147e-6f;
} // 64 x 2^-24, see docs/reference.md

} // namespace luxel
