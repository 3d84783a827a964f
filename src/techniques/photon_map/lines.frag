// SPDX-License-Identifier: MIT
// One column (or row) of pixels that the ray passes: the list of the pixel where it is half way through [Le2014, alg. 3.5].
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "techniques/photon_map/lines.glsl"

layout(binding = 3) uniform sampler2D min_max;
layout(location = 0) flat in uint ray_index;
layout(location = 0) out vec2 met; // t; node, -1: none

// Where the ray is at a pixel coordinate of the line's axis.
float ray_at(ListRay r, int axis, float x) { return (x * r.a.w - r.a[axis]) / (r.b[axis] - x * r.b.w); }

void main() {
    ListRay r = photon_ray(ray_index);
    Line line = line_of(r);
    int along = min(int(gl_FragCoord.x), line.pixels - 1), column = line.first + line.step * along;
    int ahead = line.step > 0 ? 1 : 0;
    float t = along == 0 ? r.first : ray_at(r, line.axis, float(column + 1 - ahead));
    float next = along == line.pixels - 1 ? r.last : ray_at(r, line.axis, float(column + ahead));
    ivec2 pixel = clamp(ivec2(floor(pixel_at(r, 0.5 * (t + next)))), ivec2(0), ivec2(p.view.side - 1));
    pixel[line.axis] = column;

    ListHit hit = ListHit(1e30, -1, 1u, 0u);
    float from = max(t - half_pixel(r, t), r.first), to = min(next + half_pixel(r, next), r.last);
    float z0 = r.a.z + from * r.b.z, z1 = r.a.z + to * r.b.z;
    vec2 range = texelFetch(min_max, pixel, 0).rg;
    if (max(z0, z1) >= -range.x && min(z0, z1) <= range.y) meet_list(r, pixel, p.view.side, from, to, hit);
    met = vec2(hit.t, float(hit.node));
}
