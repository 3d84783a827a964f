// SPDX-License-Identifier: MIT
// A walk over all pixels that a ray crosses, with an end at the first hit.
#include "techniques/common/fragment_lists.glsl"

layout(binding = 3) uniform sampler2D min_max; // -least and greatest depth

// Where the ray leaves the cell through the next vertical (0) or horizontal (1) border at pixel coordinate x.
float border_at(ListRay r, int axis, float x, float direction) {
    float toward = r.b[axis] - x * r.b.w;
    return toward * direction > 0.0 ? (x * r.a.w - r.a[axis]) / toward : 1e30;
}

ListHit march_lists(ListView v, ListRay r) {
    ListHit hit = ListHit(1e30, -1, 0u, 0u);
    if (!(r.first < r.last)) return hit;
    float t = r.first;
    ivec2 pixel = clamp(ivec2(floor(pixel_at(r, t))), ivec2(0), ivec2(v.side - 1));
    vec2 direction = vec2(sign_not_zero(r.b.x * r.a.w - r.a.x * r.b.w), sign_not_zero(r.b.y * r.a.w - r.a.y * r.b.w));
    ivec2 ahead = ivec2(direction.x > 0.0 ? 1 : 0, direction.y > 0.0 ? 1 : 0);
    int top = v.levels - 1, level = top;
    while (true) {
        // The cell of this level, and how far the ray is in it.
        ivec2 cell = pixel >> level;
        ivec2 border = (cell + ahead) << level;
        float tx = border_at(r, 0, float(border.x), direction.x), ty = border_at(r, 1, float(border.y), direction.y);
        float next = min(min(tx, ty), r.last);
        next = max(next, t);
        ++hit.cells;

        // Nothing in the depths that it passes: past the cell, and the next one may be larger.
        float from = max(t - half_pixel(r, t), r.first), to = min(next + half_pixel(r, next), r.last);
        float z0 = r.a.z + from * r.b.z, z1 = r.a.z + to * r.b.z;
        vec2 range = texelFetch(min_max, cell, level).rg;
        bool passes = max(z0, z1) < -range.x || min(z0, z1) > range.y;
        if (!passes && level > 0) {
            --level;
            continue;
        }
        if (!passes) meet_list(r, pixel, v.side, from, to, hit);
        if (hit.t <= next || next >= r.last) break;
        ivec2 first = cell << level, last = first + (1 << level) - 1;
        ivec2 at = clamp(ivec2(floor(pixel_at(r, next))), first, last);
        pixel = tx <= ty ? ivec2(direction.x > 0.0 ? border.x : border.x - 1, at.y)
                         : ivec2(at.x, direction.y > 0.0 ? border.y : border.y - 1);
        if (any(lessThan(pixel, ivec2(0))) || any(greaterThanEqual(pixel, ivec2(v.side)))) break;
        if (passes) level = min(level + 1, top);
        t = next;
    }
    return hit;
}
