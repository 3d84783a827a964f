// SPDX-License-Identifier: MIT
// Unit vectors in 32 bits: the sphere unfolded from an octahedron, 16 bits for each of two coordinates
// [Cigolle2014].
#ifndef LUXEL_SHARED_OCTAHEDRAL_H
#define LUXEL_SHARED_OCTAHEDRAL_H
#include "shared/glsl.h"
LUXEL_BEGIN

LUXEL_FN float sign_not_zero(float x) { return x >= 0.0f ? 1.0f : -1.0f; }

// n need not be unit, but not zero.
LUXEL_FN uint pack_unit(vec3 n) {
    vec3 p = n / (abs(n.x) + abs(n.y) + abs(n.z));
    vec2 upper = vec2(p.x, p.y);
    vec2 lower = vec2((1.0f - abs(p.y)) * sign_not_zero(p.x), (1.0f - abs(p.x)) * sign_not_zero(p.y));
    return packSnorm2x16(p.z >= 0.0f ? upper : lower);
}

LUXEL_FN vec3 unpack_unit(uint packed) {
    vec2 e = unpackSnorm2x16(packed);
    float z = 1.0f - abs(e.x) - abs(e.y);
    float below = max(-z, 0.0f);
    return normalize(vec3(e.x - sign_not_zero(e.x) * below, e.y - sign_not_zero(e.y) * below, z));
}

LUXEL_END
#endif
