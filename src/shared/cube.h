// SPDX-License-Identifier: MIT
// Texels and directions of a cube map, as Vulkan samples it: faces +x, -x, +y, -y, +z, -z; u to the right and
// v down as seen from outside with the face before one, texel centers at (i + .5) / size.
#ifndef LUXEL_SHARED_CUBE_H
#define LUXEL_SHARED_CUBE_H
#include "shared/glsl.h"
LUXEL_BEGIN

struct CubeAxes {
    vec3 forward, u, v; // unit; u x v = -forward: seen from the center a face is mirrored
};
LUXEL_FN CubeAxes cube_axes(int face) {
    float s = (face & 1) == 0 ? 1.0f : -1.0f;
    CubeAxes a;
    a.forward = vec3(0.0f, 0.0f, s), a.u = vec3(s, 0.0f, 0.0f), a.v = vec3(0.0f, -1.0f, 0.0f);
    if (face < 2) {
        a.forward = vec3(s, 0.0f, 0.0f);
        a.u = vec3(0.0f, 0.0f, -s);
    } else if (face < 4) {
        a.forward = vec3(0.0f, s, 0.0f);
        a.u = vec3(1.0f, 0.0f, 0.0f), a.v = vec3(0.0f, 0.0f, s);
    }
    return a;
}

// Toward uv in [0, 1]^2 of a face; its component along the face's axis is 1.
LUXEL_FN vec3 cube_direction(int face, vec2 uv) {
    CubeAxes a = cube_axes(face);
    return a.forward + a.u * (2.0f * uv.x - 1.0f) + a.v * (2.0f * uv.y - 1.0f);
}

struct CubePlace {
    int face;
    vec2 uv;
};
LUXEL_FN CubePlace cube_place(vec3 direction) {
    vec3 m = abs(direction);
    CubePlace p;
    if (m.x >= m.y && m.x >= m.z)
        p.face = direction.x >= 0.0f ? 0 : 1;
    else if (m.y >= m.z)
        p.face = direction.y >= 0.0f ? 2 : 3;
    else
        p.face = direction.z >= 0.0f ? 4 : 5;
    CubeAxes a = cube_axes(p.face);
    float scale = 0.5f / max(dot(direction, a.forward), 1e-30f);
    p.uv = vec2(0.5f + dot(direction, a.u) * scale, 0.5f + dot(direction, a.v) * scale);
    return p;
}

// Solid angle between the axis of a face and the corner (x, y) in [-1, 1]^2 of its plane at distance 1, with
// the sign of x y.
LUXEL_FN float cube_corner_solid_angle(float x, float y) {
    float r = sqrt(x * x + y * y + 1.0f);
    return atan(x * y, r);
}

// Solid angle of texel (i, j) of a face of `size` texels a side, sr; the sum over a face is 4 pi / 6.
LUXEL_FN float cube_texel_solid_angle(int i, int j, int size) {
    float t = 2.0f / float(size);
    float x0 = float(i) * t - 1.0f, x1 = float(i + 1) * t - 1.0f;
    float y0 = float(j) * t - 1.0f, y1 = float(j + 1) * t - 1.0f;
    return cube_corner_solid_angle(x1, y1) - cube_corner_solid_angle(x0, y1) -
           cube_corner_solid_angle(x1, y0) + cube_corner_solid_angle(x0, y0);
}

LUXEL_END
#endif
