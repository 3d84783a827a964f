// SPDX-License-Identifier: MIT
// Photons as lines.
#include "techniques/photon_map/rays.glsl"

// The pixels of the longer axis that a ray passes.
struct Line {
    int axis;   // 0: columns, 1: rows
    int first;  // pixel coordinate
    int step;   // 1 or -1
    int pixels; // so many
};
Line line_of(ListRay r) {
    vec2 from = pixel_at(r, r.first), to = pixel_at(r, r.last), way = to - from;
    Line line;
    line.axis = abs(way.x) >= abs(way.y) ? 0 : 1;
    line.step = way[line.axis] >= 0.0 ? 1 : -1;
    int last = p.view.side - 1;
    line.first = clamp(int(floor(from[line.axis])), 0, last);
    line.pixels = abs(clamp(int(floor(to[line.axis])), 0, last) - line.first) + 1;
    return line;
}
