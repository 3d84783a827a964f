// SPDX-License-Identifier: MIT
// Transmission: the part of a surface that is an interface, or a thin sheet, of a clear dielectric.
#pragma once
#include "reference/bsdf.h"

namespace luxel {

// Whether microfacets spread what the interface reflects and lets through; otherwise both are ideal.
bool is_rough_glass(const Surface& surface);

// Smooth: reflection and refraction by exact Fresnel; a thin sheet lets light pass unbent.
BsdfSample sample_smooth_glass(const ShadingPoint& point, float u);

// Rough: direction by a visible microfacet, reflected or let through as `choice` says, and the value and
// density of any direction. Zero direction: the facet leads nowhere.
glm::vec3 sample_rough_glass(const ShadingPoint& point, glm::vec2 u, float choice);
struct GlassValue {
    glm::vec3 value{0.0f}; // BSDF times cosine
    float pdf = 0.0f;      // of sample_rough_glass
};
GlassValue evaluate_rough_glass(const ShadingPoint& point, glm::vec3 wi);

} // namespace luxel
