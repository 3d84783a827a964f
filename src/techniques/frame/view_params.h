// SPDX-License-Identifier: MIT
// The camera as shaders read it.
#ifndef LUXEL_FRAME_VIEW_PARAMS_H
#define LUXEL_FRAME_VIEW_PARAMS_H
#include "shared/glsl.h"
LUXEL_BEGIN

struct ViewParams {
    mat4 world_to_clip; // depth near / z: 1 at the near plane, 0 at infinity
    vec3 position;      // world
    float near;
    vec3 forward; // unit
    float far;
    vec3 right;  // scaled by the half width at distance 1
    float width; // pixels
    vec3 up;     // scaled by the half height at distance 1
    float height;
};

// World position of the pixel coordinate (centers at .5, row 0 on top) at linear depth z [Rohleder2010, eq.
// 24].
LUXEL_FN vec3 world_position(ViewParams v, vec2 pixel, float z) {
    vec3 d =
        v.forward + v.right * (2.0f * pixel.x / v.width - 1.0f) - v.up * (2.0f * pixel.y / v.height - 1.0f);
    return v.position + d * z;
}

LUXEL_END
#endif
