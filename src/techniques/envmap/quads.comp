// SPDX-License-Identifier: MIT
// Senders as polygons.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/envmap/list.glsl"

void main() {
    int i = int(gl_GlobalInvocationID.x), count = 6 * p.texels * p.texels;
    if (i >= count) return;
    Sender s = sender_of(i);
    int at = (p.probe * count + i) * ENVMAP_QUAD;
    element[at] = vec4(p.center + s.corners.a, s.radiance.r);
    element[at + 1] = vec4(p.center + s.corners.b, s.radiance.g);
    element[at + 2] = vec4(p.center + s.corners.c, s.radiance.b);
    element[at + 3] = vec4(p.center + s.corners.d, 0);
}
