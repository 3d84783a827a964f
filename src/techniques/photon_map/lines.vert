// SPDX-License-Identifier: MIT
// A ray as a line in its own row: as long as it has pixels along its longer axis [Le2014, 3.3.2.2] [Kruger2006].
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "techniques/photon_map/lines.glsl"

layout(location = 0) flat out uint ray_index;

void main() {
    int row = gl_VertexIndex / 2;
    ray_index = uint(p.first_row + row);
    gl_Position = vec4(2.0, 2.0, 0.5, 1.0);
    if (!flies(ray_index)) return;
    ListRay r = photon_ray(ray_index);
    if (!(r.first < r.last)) return;
    Line line = line_of(r);
    float x = gl_VertexIndex % 2 == 0 ? 0.0 : float(line.pixels);
    gl_Position = vec4(2.0 * x / float(p.view.side + 1) - 1.0, 1.0 - 2.0 * (float(row) + 0.5) / float(p.rows), 0.5, 1.0);
}
