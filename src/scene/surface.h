// SPDX-License-Identifier: MIT
// What a ray finds at a hit: geometry and the material's textures, looked up bilinearly at mip 0.
#pragma once
#include "scene/raycast.h"
#include "scene/scene.h"
#include "shared/brdf.h"

namespace luxel {

struct Surface {
    glm::vec3 position;         // world; on the triangle
    glm::vec3 geometric_normal; // unit, by winding (not flipped)
    glm::vec3 normal;           // unit shading normal incl. normal map, in the hemisphere of geometric_normal
    const Material* material;
    shared::Brdf brdf;
    float metallic, roughness, transmission;
    glm::vec3 base_color; // linear, texture x factor x vertex color
    glm::vec3 emission;   // radiance of the front side (of both sides if double_sided)
    bool front;           // the ray came from the side that geometric_normal points to
};

// direction: of the ray that hit.
Surface surface_at(const Scene& scene, const Hit& hit, glm::vec3 direction);

// RGBA in [0, 1], linear (srgb textures decoded). Texel (0, 0) is the top left; uv (0, 0) is its corner.
glm::vec4 sample_texture(const Texture& texture, glm::vec2 uv);

} // namespace luxel
