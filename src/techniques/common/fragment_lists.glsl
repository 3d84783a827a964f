// SPDX-License-Identifier: MIT
// Rays against per-pixel lists. Positions are relative to the view's center.
#ifndef LUXEL_FRAGMENT_LISTS_GLSL
#define LUXEL_FRAGMENT_LISTS_GLSL
#include "shared/octahedral.h"
#include "techniques/common/fragment_lists_params.h"

layout(binding = 1, scalar) readonly buffer heads { uint head_of[]; };
layout(binding = 2, scalar) readonly buffer nodes { uvec4 node_of[]; };

struct ListRay {
    vec3 o, d; // d: unit
    bool inside;  // of glass
    vec4 a, b; // view.to_pixel of o + t d is a + t b
    float slide;   // how fast the ray crosses pixels: w^2 / slide is the length over one pixel
    float first, last; // what the view sees of it, m; first > last: nothing
};
struct ListHit {
    float t;
    int node; // -1: none
    uint cells, nodes; // visited
};

// Clips to f0 + t f1 >= 0.
void clip_ray(inout ListRay r, float f0, float f1) {
    float t = -f0 / f1;
    if (f1 > 0.0) r.first = max(r.first, t);
    else if (f1 < 0.0) r.last = min(r.last, t);
    else if (f0 < 0.0) r.last = -1.0;
}

ListRay list_ray(ListView v, vec3 o, vec3 d, bool inside, float start) {
    ListRay r;
    r.o = o;
    r.d = d;
    r.inside = inside;
    r.a = v.to_pixel * vec4(o, 1.0);
    r.b = v.to_pixel * vec4(d, 0.0);
    r.slide = max(max(abs(r.b.x * r.a.w - r.a.x * r.b.w), abs(r.b.y * r.a.w - r.a.y * r.b.w)), 1e-12);
    r.first = start;
    r.last = v.longest;
    float side = float(v.side);
    clip_ray(r, r.a.z - v.near, r.b.z);
    clip_ray(r, r.a.x, r.b.x);
    clip_ray(r, r.a.y, r.b.y);
    clip_ray(r, side * r.a.w - r.a.x, side * r.b.w - r.b.x);
    clip_ray(r, side * r.a.w - r.a.y, side * r.b.w - r.b.y);
    return r;
}

vec2 pixel_at(ListRay r, float t) { return (r.a.xy + t * r.b.xy) / (r.a.w + t * r.b.w); }

// Length of the ray over half a pixel. A surface's edge is half a pixel at most from the last center that shows it, so
// that a facet counts so far beyond its own pixel: else rays slip through between two facets that meet.
float half_pixel(ListRay r, float t) {
    float w = r.a.w + t * r.b.w;
    return 0.5 * w * w / r.slide;
}

bool list_side_counts(uint what, bool from_behind, bool inside) {
    if ((what & LIST_GLASS) != 0u) return from_behind == inside;
    return (what & LIST_MIRROR) == 0u || !from_behind;
}

// The nearest facet of a pixel's list that the ray meets between two of its points. The ray's depth interval over the
// pixel against the facet's own interval there [Le2014, alg. 3.5 has the facet's depth at the center and a
// threshold]: the ray is on both sides of the plane.
void meet_list(ListRay r, ivec2 pixel, int side, float from, float to, inout ListHit hit) {
    for (uint i = head_of[pixel.y * side + pixel.x]; i != LIST_END;) {
        uvec4 node = node_of[i];
        vec3 n = unpack_unit(node[LIST_NORMAL]);
        float slope = dot(n, r.d);
        float t = (uintBitsToFloat(node[LIST_OFFSET]) - dot(n, r.o)) / slope;
        if (t >= from && t <= to && t < hit.t && list_side_counts(node[LIST_WHAT], slope > 0.0, r.inside)) {
            hit.t = t;
            hit.node = int(i);
        }
        ++hit.nodes;
        i = node[LIST_NEXT];
    }
}
#endif
