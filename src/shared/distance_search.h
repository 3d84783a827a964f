// SPDX-License-Identifier: MIT
// Rays against surfaces that are known as distances from a center in each direction, layer by layer
// [Umenhoffer2009, 2.3.2, 5.1.2]. Positions are relative to the center, rays are x + d r with unit r. The
// including file defines the three functions declared first.
#ifndef LUXEL_SHARED_DISTANCE_SEARCH_H
#define LUXEL_SHARED_DISTANCE_SEARCH_H
#include "shared/glsl.h"
LUXEL_BEGIN

// Distance of the surface in that direction, m; beyond everything where there is none.
float surface_distance(vec3 direction, int layer);
// Whether a ray along r that reaches the surface at p has hit it: it may face the wrong way.
bool surface_counts(vec3 p, vec3 r, int layer);
// Normal of that surface, on either side and of any length.
vec3 surface_normal(vec3 direction, int layer);

LUXEL_CONST int REFINE_NONE = 0;
LUXEL_CONST int REFINE_SECANT = 1;
LUXEL_CONST int REFINE_BINARY = 2;

struct DistanceSearch {
    int linear; // steps at most, for a ray that turns by 180 degrees as seen from the center
    int refine; // steps of refinement at most
    float jump; // distance off the surface's plane, or change of distance, over two texels, as a share: a gap
    float texel; // radians
};

struct RayRange {
    float first;
    float last; // below first: the ray misses
};

// The part of a ray between two spheres around the center. A ray that passes through the inner one and starts
// outside of it keeps what is inside: the second part may hold its hit [Umenhoffer2009, fig. 5.3].
LUXEL_FN RayRange range_between(vec3 x, vec3 r, float nearest, float farthest) {
    float b = dot(x, r);
    float height2 = max(dot(x, x) - b * b, 0.0f); // squared distance of the ray's line
    float outer = farthest * farthest - height2;
    float inner = nearest * nearest - height2;
    RayRange range;
    range.first = 0.0f, range.last = -1.0f;
    if (outer <= 0.0f) return range;
    range.last = sqrt(outer) - b;
    range.first = max(-sqrt(outer) - b, 0.0f);
    if (dot(x, x) < nearest * nearest) range.first = max(range.first, sqrt(max(inner, 0.0f)) - b);
    return range;
}

// Over 0: behind the surface as seen from the center ("overshooting"); below: in front of it.
LUXEL_FN float overshoot(vec3 p, int layer) { return length(p) / surface_distance(p, layer) - 1.0f; }

struct RayHit {
    float d;
    int layer; // -1: none
};

// Step i of n between both ends of a range, even in the directions seen from the center
// [Umenhoffer2009, 5.1.2]; wa and wb are one over the ends' distances from it.
LUXEL_FN float ray_step(RayRange range, float wa, float wb, float t) {
    float a = (1.0f - t) * wa;
    float b = t * wb;
    return (a * range.first + b * range.last) / (a + b);
}

// Narrows a bracket. The secant step is false position: one end stays in front of the surface, one behind it
// [Umenhoffer2009, eq. 2.3, whose ratios are |l|/|l'|].
LUXEL_FN float refine_hit(vec3 x, vec3 r, int layer, float d0, float e0, float d1, float e1, int kind,
                          int steps) {
    float d = d1;
    for (int i = 0; i < steps; ++i) {
        d = 0.5f * (d0 + d1);
        if (kind == REFINE_SECANT) d = d0 - (d1 - d0) * e0 / (e1 - e0);
        float e = overshoot(x + r * d, layer);
        bool same = (e > 0.0f) == (e0 > 0.0f);
        d0 = same ? d : d0;
        e0 = same ? e : e0;
        d1 = same ? d1 : d;
        e1 = same ? e1 : e;
    }
    return d;
}

// Two texels apart on the ray's way as seen from the center, a surface has nearly one distance, or distances
// that lie on the plane of its normal, as a floor has that the center sees at a grazing angle. The linear
// filter makes a wall of a gap that the search would hit otherwise.
LUXEL_FN bool is_surface(vec3 p, vec3 r, int layer, DistanceSearch s) {
    float distance = length(p);
    vec3 along = r - p * (dot(p, r) / (distance * distance));
    float length_along = length(along);
    if (length_along < 1e-4f) return true;
    along = along * (distance * s.texel / length_along);
    float before = surface_distance(p - along, layer);
    float after = surface_distance(p + along, layer);
    if (max(before, after) < (1.0f + s.jump) * min(before, after)) return true;
    vec3 n = surface_normal(p, layer);
    float facing_before = dot(n, normalize(p - along));
    float facing_after = dot(n, normalize(p + along));
    if (facing_before * facing_after <= 0.0f) return false;
    float on_plane = before * facing_before / facing_after;
    return max(on_plane, after) < (1.0f + s.jump) * min(on_plane, after);
}

// First hit of a layer within a range. Without refinement it is the first step behind the surface.
LUXEL_FN RayHit search_layer(vec3 x, vec3 r, RayRange range, int layer, int kind, DistanceSearch s) {
    RayHit hit;
    hit.d = 0.0f, hit.layer = -1;
    if (range.last <= range.first) return hit;
    vec3 a = x + r * range.first;
    vec3 b = x + r * range.last;
    float wa = 1.0f / max(length(a), 1e-12f);
    float wb = 1.0f / max(length(b), 1e-12f);
    int steps = clamp(int(ceil(0.5f * float(s.linear) * length(a * wa - b * wb))), 1, s.linear);

    float d0 = range.first;
    float e0 = overshoot(a, layer);
    for (int i = 1; i <= steps; ++i) {
        float d1 = ray_step(range, wa, wb, float(i) / float(steps));
        float e1 = overshoot(x + r * d1, layer);
        if ((e1 > 0.0f) != (e0 > 0.0f)) {
            float d = d1;
            if (kind != REFINE_NONE) d = refine_hit(x, r, layer, d0, e0, d1, e1, kind, s.refine);
            vec3 p = x + r * d;
            if (is_surface(p, r, layer, s) && surface_counts(p, r, layer)) {
                hit.d = d, hit.layer = layer;
                return hit;
            }
        }
        d0 = d1;
        e0 = e1;
    }
    return hit;
}

// Environment mapping with the distance for parallax: the surface is taken to stand across the ray at the
// distance of the last guess [Umenhoffer2009, eq. 2.2]. No steps: the direction alone.
LUXEL_FN vec3 parallax_guess(vec3 x, vec3 r, int layer, int steps) {
    vec3 p = r * surface_distance(r, layer);
    for (int i = 0; i < steps; ++i) {
        float d = length(p) - dot(r, x);
        p = x + r * max(d, 0.0f);
        p = p * (surface_distance(p, layer) / max(length(p), 1e-12f));
    }
    return p;
}

LUXEL_END
#endif
