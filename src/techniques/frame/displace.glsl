// SPDX-License-Identifier: MIT
// The relief behind a polygon, found for each pixel. Include after material.glsl, with DISPLACED defined.
#include "shared/height_field.h"

// Bilinear at 32 bits, from one gather at the corner that the four texels share.
float height_at(HeightField field, vec2 uv) {
    vec2 x = uv * field.size - 0.5;
    vec2 corner = floor(x), f = x - corner;
    vec4 h = textureGather(height_texture, (corner + 1.0) / field.size);
    vec2 rows = vec2(h.w + f.x * (h.z - h.w), h.x + f.x * (h.y - h.x));
    return rows.x + f.y * (rows.y - rows.x);
}

struct Displaced {
    float t;       // depth, 0 on the polygon, 1 at the bottom
    vec3 along;    // world, from the polygon to the bottom
    vec2 gradient; // of the height
    TextureAxes axes;
};

// position: the pixel's point on the polygon, up to a constant; from_eye: toward it; plane: the polygon's unit
// normal, toward the eye; uv: both sets. Only fronts have a relief. Sets uv_shift.
Displaced displace(vec3 position, vec3 from_eye, vec3 plane, vec4 uv, HeightSearch search, bool front) {
    vec3 edge1 = dFdx(position), edge2 = dFdy(position);
    TextureAxes first = texture_axes(edge1, edge2, dFdx(uv.xy), dFdy(uv.xy));
    TextureAxes second = texture_axes(edge1, edge2, dFdx(uv.zw), dFdy(uv.zw));
    TextureRecord use = m.height_texture;
    bool is_first = use.set == 0u;
    vec3 u = is_first ? first.u : second.u, v = is_first ? first.v : second.v;
    Displaced d;
    d.axes = TextureAxes(u * use.u_row.x + v * use.u_row.y, u * use.v_row.x + v * use.v_row.y);

    HeightRay ray;
    vec3 at = vec3(is_first ? uv.xy : uv.zw, 1.0), way = normalize(from_eye);
    ray.uv = vec2(dot(use.u_row, at), dot(use.v_row, at));
    ray.cosine = max(-dot(way, plane), 1e-4);
    d.along = way * (m.height_scale / ray.cosine);
    ray.slope = vec2(dot(d.along, d.axes.u), dot(d.along, d.axes.v));

    HeightField field = HeightField(use.size);
    float t = search_height(field, ray, search);
    d.t = front ? t : 0.0;
    d.gradient = front ? height_gradient(field, ray.uv + ray.slope * t) : vec2(0.0);
    uv_shift = vec4(dot(d.along, first.u), dot(d.along, first.v), dot(d.along, second.u),
                    dot(d.along, second.v)) * d.t;
    return d;
}
