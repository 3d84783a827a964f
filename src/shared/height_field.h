// SPDX-License-Identifier: MIT
// Height fields on macrostructure polygons, and where a ray meets them [Umenhoffer2009, section 2.1]. A
// height of 1 lies on the polygon, 0 the whole depth of the relief behind it, so that all detail is inside.
#ifndef LUXEL_SHARED_HEIGHT_FIELD_H
#define LUXEL_SHARED_HEIGHT_FIELD_H
#include "shared/height_search.h"

// What is searched: texels a side, and a height for every texture coordinate. GLSL defines
// height_at itself.
#ifdef __cplusplus
#include <functional>
#endif
LUXEL_BEGIN

struct HeightField {
    vec2 size;
#ifdef __cplusplus
    std::function<float(vec2)> height;
#endif
};
#ifdef __cplusplus
inline float height_at(const HeightField& field, vec2 uv) { return field.height(uv); }
#else
float height_at(HeightField field, vec2 uv);
#endif

// The view ray behind the polygon: texture coordinates uv + t slope at the depth t, 0 on the polygon and 1 at
// the bottom [Umenhoffer2009, eq. 2.1 with t = 1 - H].
struct HeightRay {
    vec2 uv, slope;
    float cosine; // between the ray and the polygon's normal
};

// How far the ray at t is below the field; negative above it.
LUXEL_FN float height_gap(HeightField field, HeightRay ray, float t) {
    return t - 1.0f + height_at(field, ray.uv + ray.slope * t);
}

// Change of the height per t, over the distance of one texel.
LUXEL_FN float height_along(HeightField field, HeightRay ray, float t) {
    float step = 1.0f / max(max(abs(ray.slope.x) * field.size.x, abs(ray.slope.y) * field.size.y), 1.0f);
    float ahead = height_at(field, ray.uv + ray.slope * (t + 0.5f * step));
    return (ahead - height_at(field, ray.uv + ray.slope * (t - 0.5f * step))) / step;
}

// One correction: the field is taken for the plane through its point at t. On a plane of constant height the
// gap is the whole way (weight 1); with a slope s along the ray it closes at the rate 1 + s. A plane that
// falls away from the ray is met no farther than at the bottom. Repeated corrections take |s|, so that none
// of them overshoots; [Premecz2006] damps them by the normal's z instead.
LUXEL_FN float parallax_step(HeightField field, HeightRay ray, float t, uint mode) {
    float gap = height_gap(field, ray, t);
    float weight = 1.0f;
    if (mode == PARALLAX_OFFSET_LIMIT) weight = ray.cosine; // [Welsh2004]
    if (mode == PARALLAX_SLOPE) weight = 1.0f / max(1.0f + height_along(field, ray, t), max(abs(gap), 1e-6f));
    if (mode == PARALLAX_ITERATED) weight = 1.0f / (1.0f + abs(height_along(field, ray, t)));
    return clamp(t - gap * weight, 0.0f, 1.0f);
}

// Two points on the ray that enclose a crossing, and how far each is below the field.
struct HeightInterval {
    float above, below, above_gap, below_gap;
};

// The first of `steps` equal steps that ends below the field. A ray that enters on the field stays there:
// both ends are 0.
LUXEL_FN HeightInterval linear_search(HeightField field, HeightRay ray, int steps) {
    HeightInterval i;
    i.above = 0.0f, i.below = 0.0f;
    i.above_gap = height_gap(field, ray, 0.0f), i.below_gap = i.above_gap;
    for (int k = 1; k <= steps && i.below_gap < 0.0f; ++k) {
        i.above = i.below, i.above_gap = i.below_gap;
        i.below = float(k) / float(steps);
        i.below_gap = height_gap(field, ray, i.below);
    }
    return i;
}

// Keeps the part of the interval on whose ends' gaps the signs differ.
LUXEL_FN HeightInterval narrowed(HeightField field, HeightRay ray, HeightInterval i, float t) {
    float gap = height_gap(field, ray, t);
    if (gap < 0.0f)
        i.above = t, i.above_gap = gap;
    else
        i.below = t, i.below_gap = gap;
    return i;
}

LUXEL_FN float middle(HeightInterval i) { return 0.5f * (i.above + i.below); }

// Where the ray meets the line between the field at the interval's ends.
LUXEL_FN float crossing(HeightInterval i) {
    float rise = i.below_gap - i.above_gap;
    return rise > 0.0f ? i.above - (i.below - i.above) * (i.above_gap / rise) : i.below;
}

// The depth t at which the ray meets the field. Loops of no steps cost nothing, where branches would.
LUXEL_FN float search_height(HeightField field, HeightRay ray, HeightSearch search) {
    float t = 0.0f;
    for (int k = 0; k < search.parallax_steps; ++k) t = parallax_step(field, ray, t, search.parallax_mode);
    HeightInterval i = linear_search(field, ray, search.linear_steps);
    for (int k = 0; k < search.binary_steps; ++k) i = narrowed(field, ray, i, middle(i));
    for (int k = 0; k < search.secant_steps; ++k) i = narrowed(field, ray, i, crossing(i));
    if (search.parallax_steps > 0) return t;
    return mix(middle(i), crossing(i), search.interpolates);
}

// World gradients of the texture coordinates on a plane, from two edges in it and their coordinates'
// differences.
struct TextureAxes {
    vec3 u, v;
};
LUXEL_FN TextureAxes texture_axes(vec3 edge1, vec3 edge2, vec2 uv1, vec2 uv2) {
    vec3 n = cross(edge1, edge2);
    float scale = 1.0f / max(dot(n, n), 1e-30f);
    vec3 a = cross(edge2, n) * scale, b = cross(n, edge1) * scale;
    TextureAxes axes;
    axes.u = a * uv1.x + b * uv2.x;
    axes.v = a * uv1.y + b * uv2.y;
    return axes;
}

// Change of the height over one texel, per texture coordinate.
LUXEL_FN vec2 height_gradient(HeightField field, vec2 uv) {
    vec2 half_u = vec2(0.5f / field.size.x, 0.0f), half_v = vec2(0.0f, 0.5f / field.size.y);
    return vec2((height_at(field, uv + half_u) - height_at(field, uv - half_u)) * field.size.x,
                (height_at(field, uv + half_v) - height_at(field, uv - half_v)) * field.size.y);
}

// The normal n of the polygon, bent to that of a relief of so many meters; where it is flat, bit by bit as it
// was.
LUXEL_FN vec3 relief_normal(vec3 n, vec2 gradient, TextureAxes axes, float meters) {
    if (gradient == vec2(0.0f)) return n;
    return normalize(n - (axes.u * gradient.x + axes.v * gradient.y) * meters);
}

LUXEL_END
#endif
