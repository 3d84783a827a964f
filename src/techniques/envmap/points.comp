// SPDX-License-Identifier: MIT
// Senders as points with an area.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/envmap/list.glsl"

void main() {
    int i = int(gl_GlobalInvocationID.x), count = 6 * p.texels * p.texels;
    if (i >= count) return;
    Sender s = sender_of(i);
    Quad q = s.corners;
    vec3 area = 0.5 * cross(q.d - q.b, q.c - q.a);
    int at = (p.probe * count + i) * ENVMAP_POINT;
    element[at] = vec4(p.center + 0.25 * (q.a + q.b + q.c + q.d), s.radiance.r);
    element[at + 1] = vec4(area, s.radiance.g);
    element[at + 2] = vec4(s.radiance.b, 0, 0, 0);
}
