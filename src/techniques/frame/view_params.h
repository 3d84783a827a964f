// SPDX-License-Identifier: MIT
// A camera, or a light's view, as shaders read it.
#ifndef LUXEL_FRAME_VIEW_PARAMS_H
#define LUXEL_FRAME_VIEW_PARAMS_H
#include "shared/glsl.h"
LUXEL_BEGIN

struct ViewParams {
    mat4 world_to_clip; // depth near / z: 1 at the near plane, 0 at infinity; parallel: 1 - z / far
    vec3 position;      // world; parallel: middle of the plane z = 0
    float near;
    vec3 forward; // unit
    float far;
    vec3 right;  // scaled by the half width at distance 1; parallel: by the half width
    float width; // pixels
    vec3 up;     // scaled by the half height, likewise
    float height;
    float parallel; // 0 perspective, 1 orthographic
};

// Along the view ray through a pixel coordinate; its component along `forward` is 1.
LUXEL_FN vec3 pixel_direction(ViewParams v, vec2 pixel) {
    float spread = 1.0f - v.parallel;
    return v.forward + v.right * ((2.0f * pixel.x / v.width - 1.0f) * spread) -
           v.up * ((2.0f * pixel.y / v.height - 1.0f) * spread);
}

// World position of the pixel coordinate (centers at .5, row 0 on top) at linear depth z [Rohleder2010, eq.
// 24].
LUXEL_FN vec3 world_position(ViewParams v, vec2 pixel, float z) {
    vec3 origin = v.position + v.right * ((2.0f * pixel.x / v.width - 1.0f) * v.parallel) -
                  v.up * ((2.0f * pixel.y / v.height - 1.0f) * v.parallel);
    return origin + pixel_direction(v, pixel) * z;
}

LUXEL_END
#endif
