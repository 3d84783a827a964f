// SPDX-License-Identifier: MIT
// Projected solid angle of quadrilaterals: a uniform quad of radiance L sends the irradiance L times it.
#ifndef LUXEL_SHARED_FORM_FACTOR_H
#define LUXEL_SHARED_FORM_FACTOR_H
#include "shared/glsl.h"
LUXEL_BEGIN

// Corners relative to the receiver, any lengths; counter-clockwise as seen from the receiver where it sends.
struct Quad {
    vec3 a, b, c, d;
};

// Area of the sector that an edge cuts out of the unit disc in the plane of n: half its angle times the
// cosine between its plane and n, with a sign [Umenhoffer2009, eq. 3.3; Lambert1760]. The two-argument arc
// tangent keeps its digits at every angle, an arc cosine would not.
LUXEL_FN float edge_sector(vec3 a, vec3 b, vec3 n) {
    vec3 c = cross(a, b);
    float s = length(c);
    return 0.5f * atan(s, dot(a, b)) * dot(c, n) / max(s, 1e-30f);
}

// Edges clamped one by one, as in algorithm 1 of the thesis: too much wherever a quad does not enclose n.
LUXEL_FN float quad_factor_thesis(Quad q, vec3 n) {
    return max(edge_sector(q.a, q.b, n), 0.0f) + max(edge_sector(q.b, q.c, n), 0.0f) +
           max(edge_sector(q.c, q.d, n), 0.0f) + max(edge_sector(q.d, q.a, n), 0.0f);
}

// The sum clamped: exact above the horizon, too small across it.
LUXEL_FN float quad_factor_clamp_sum(Quad q, vec3 n) {
    return max(edge_sector(q.a, q.b, n) + edge_sector(q.b, q.c, n) + edge_sector(q.c, q.d, n) +
                   edge_sector(q.d, q.a, n),
               0.0f);
}

// A walk around a polygon's boundary: the sectors of what lies above the horizon, and where it was crossed.
struct HorizonWalk {
    float sum;
    float exits; // number of crossings downward
    vec3 exit_first, exit_last, entry_first, entry_last;
    float entries;
};

LUXEL_FN HorizonWalk walk_edge(HorizonWalk w, vec3 p, vec3 q, vec3 n) {
    float hp = dot(p, n), hq = dot(q, n);
    // Toward the point on the horizon; below it both ends are that point, and the sector is empty.
    vec3 crossing = p * abs(hq) + q * abs(hp);
    vec3 from = hp >= 0.0f ? p : crossing;
    vec3 to = hq >= 0.0f ? q : crossing;
    w.sum += edge_sector(from, to, n);
    if (hp >= 0.0f && hq < 0.0f) {
        w.exit_first = w.exits == 0.0f ? crossing : w.exit_first;
        w.exit_last = crossing;
        w.exits += 1.0f;
    }
    if (hp < 0.0f && hq >= 0.0f) {
        w.entry_first = w.entries == 0.0f ? crossing : w.entry_first;
        w.entry_last = crossing;
        w.entries += 1.0f;
    }
    return w;
}

// What lies above the horizon, exactly. Each way down is closed along the horizon to the next way up; a quad
// whose corners are not in one plane may have two of them.
LUXEL_FN float quad_factor_clip(Quad q, vec3 n) {
    HorizonWalk w;
    w.sum = 0.0f, w.exits = 0.0f, w.entries = 0.0f;
    w.exit_first = w.exit_last = w.entry_first = w.entry_last = vec3(0.0f);
    w = walk_edge(w, q.a, q.b, n);
    w = walk_edge(w, q.b, q.c, n);
    w = walk_edge(w, q.c, q.d, n);
    w = walk_edge(w, q.d, q.a, n);
    bool starts_above = dot(q.a, n) >= 0.0f;
    float first = edge_sector(w.exit_first, starts_above ? w.entry_first : w.entry_last, n);
    float second = edge_sector(w.exit_last, starts_above ? w.entry_last : w.entry_first, n);
    return max(w.sum + first + (w.exits > 1.0f ? second : 0.0f), 0.0f);
}

// The quad as a point with its normal and area: without bound near it. center relative to the receiver, area:
// normal toward the sender's front times area.
LUXEL_FN float point_factor(vec3 center, vec3 area, vec3 n) {
    float r2 = max(dot(center, center), 1e-20f);
    return max(dot(n, center), 0.0f) * max(-dot(area, center), 0.0f) / (r2 * r2);
}

// The same as a disc of that area facing its normal: at most pi.
LUXEL_FN float disc_factor(vec3 center, vec3 area, vec3 n) {
    float r2 = dot(center, center);
    return max(dot(n, center), 0.0f) * max(-dot(area, center), 0.0f) /
           max(r2 * (r2 + length(area) / PI), 1e-20f);
}

LUXEL_END
#endif
