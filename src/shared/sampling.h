// SPDX-License-Identifier: MIT
// Warps from the unit square to directions and discs, each with its density in its comment.
#ifndef LUXEL_SHARED_SAMPLING_H
#define LUXEL_SHARED_SAMPLING_H
#include "shared/glsl.h"
LUXEL_BEGIN

// Right-handed orthonormal frame around a unit vector [Duff2017]; columns: tangent, bitangent, n.
LUXEL_FN mat3 frame_around(vec3 n) {
    float s = n.z >= 0.0f ? 1.0f : -1.0f;
    float a = -1.0f / (s + n.z);
    float b = n.x * n.y * a;
    return mat3(vec3(1.0f + s * n.x * n.x * a, s * b, -s * n.x), vec3(b, s + n.y * n.y * a, -n.y), n);
}

// Uniform on the unit disc, density 1/pi [Shirley1997].
LUXEL_FN vec2 sample_disc(vec2 u) {
    vec2 p = u * 2.0f - vec2(1.0f);
    if (p.x == 0.0f && p.y == 0.0f) return vec2(0.0f);
    bool wide = abs(p.x) > abs(p.y);
    float r = wide ? p.x : p.y;
    float phi = wide ? (PI / 4.0f) * (p.y / p.x) : PI / 2.0f - (PI / 4.0f) * (p.x / p.y);
    return vec2(r * cos(phi), r * sin(phi));
}

// Around +z, density cos/pi.
LUXEL_FN vec3 sample_cosine_hemisphere(vec2 u) {
    vec2 d = sample_disc(u);
    return vec3(d.x, d.y, sqrt(max(0.0f, 1.0f - dot(d, d))));
}

// Whole sphere, density 1/(4 pi).
LUXEL_FN vec3 sample_sphere(vec2 u) {
    float z = 1.0f - 2.0f * u.x;
    float r = sqrt(max(0.0f, 1.0f - z * z));
    float phi = 2.0f * PI * u.y;
    return vec3(r * cos(phi), r * sin(phi), z);
}

// A GGX micronormal as seen from wo (around +z, wo.z > 0), density G1(wo) D(h) max(wo.h, 0) / wo.z
// [Heitz2018, listing 1].
LUXEL_FN vec3 sample_visible_normal(vec3 wo, float alpha, vec2 u) {
    // Stretch the view, so that the ellipsoid of normals becomes a hemisphere.
    vec3 v = normalize(vec3(alpha * wo.x, alpha * wo.y, wo.z));
    float l2 = v.x * v.x + v.y * v.y;
    vec3 t = l2 > 0.0f ? vec3(-v.y, v.x, 0.0f) / sqrt(l2) : vec3(1.0f, 0.0f, 0.0f);
    vec3 b = cross(v, t);

    // A point of the hemisphere's projection along the view: a disc whose lower half is squeezed.
    float r = sqrt(u.x);
    float phi = 2.0f * PI * u.y;
    float x = r * cos(phi);
    float s = 0.5f * (1.0f + v.z);
    float y = (1.0f - s) * sqrt(max(0.0f, 1.0f - x * x)) + s * (r * sin(phi));
    vec3 h = t * x + b * y + v * sqrt(max(0.0f, 1.0f - x * x - y * y));
    return normalize(vec3(alpha * h.x, alpha * h.y, max(h.z, 1e-7f)));
}

// Element i of the Hammersley set of n: low-discrepancy points of the unit square.
LUXEL_FN vec2 hammersley(uint i, uint n) {
    uint b = (i << 16u) | (i >> 16u);
    b = ((b & 0x55555555u) << 1u) | ((b & 0xAAAAAAAAu) >> 1u);
    b = ((b & 0x33333333u) << 2u) | ((b & 0xCCCCCCCCu) >> 2u);
    b = ((b & 0x0F0F0F0Fu) << 4u) | ((b & 0xF0F0F0F0u) >> 4u);
    b = ((b & 0x00FF00FFu) << 8u) | ((b & 0xFF00FF00u) >> 8u);
    return vec2((float(i) + 0.5f) / float(n), float(b >> 8u) * (1.0f / 16777216.0f));
}

LUXEL_END
#endif
