// SPDX-License-Identifier: MIT
// Virtual point lights [Keller1997] and what they send.
#ifndef LUXEL_COMMON_VPL_PARAMS_H
#define LUXEL_COMMON_VPL_PARAMS_H
#include "shared/light.h"
#include "shared/sampling.h"
#include "techniques/frame/view_params.h"
LUXEL_BEGIN

// As texels of a buffer: (position, bound), (normal, 0), (flux, 0).
LUXEL_CONST int VPL_TEXELS = 3;
struct Vpl {
    vec3 position; // world, m
    float bound;   // m2: area that the light stands for over pi
    vec3 normal;   // geometric, on the lit side
    vec3 flux;     // W that the Lambertian lobe sends on
};

LUXEL_CONST uint VPL_EVEN = 0u;
LUXEL_CONST uint VPL_GRID = 1u;

struct VplSampleParams {
    ViewParams view;
    Light light;
    int first, count; // in the list of candidates
    uint pattern;     // VPL_*
    uint disc;        // 1: in the circle that touches the image's sides
    vec2 shift;       // of the pattern on the unit square, VPL_EVEN only
};

struct VplCompactParams {
    int candidates;
};

// Element i of `count` in the unit square. Grid: a point in each of N x N cells, count = N^2, by a fixed
// table of random numbers [Le2014, 3.2.1].
LUXEL_FN vec2 vpl_unit_point(int i, int count, uint pattern, vec2 shift, vec2 random) {
    if (pattern == VPL_GRID) {
        int n = int(sqrt(float(count)) + 0.5f);
        return (vec2(float(i % n), float(i / n)) + random) / float(n);
    }
    vec2 u = hammersley(uint(i), uint(count)) + shift;
    return u - floor(u);
}

// Where on the image; the polar map has a uniform density on the disc [Le2014, 3.2.1].
LUXEL_FN vec2 vpl_image_point(vec2 u, bool disc) {
    if (!disc) return u;
    float r = 0.5f * sqrt(u.x), phi = 2.0f * PI * u.y;
    return vec2(0.5f + r * cos(phi), 0.5f + r * sin(phi));
}

// Pixels of a square image that one light of `count` stands for.
LUXEL_FN float pixels_per_vpl(float side, int count, bool disc) {
    return side * side * (disc ? PI / 4.0f : 1.0f) / float(count);
}

// Least cosine between a surface and the light's ray when a pixel's area on it is bounded.
LUXEL_CONST float VPL_GRAZING = 0.01f;

LUXEL_END
#endif
