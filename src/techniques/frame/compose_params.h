// SPDX-License-Identifier: MIT
// Parameters of the composition.
#ifndef LUXEL_FRAME_COMPOSE_PARAMS_H
#define LUXEL_FRAME_COMPOSE_PARAMS_H
#include "techniques/frame/view_params.h"
LUXEL_BEGIN

struct ComposeParams {
    ViewParams view;
    float environment_rotation; // radians
    float environment_scale;    // 0 = none
};

// Where a direction falls in an equirectangular map, in [0, 1]^2 (the convention of Environment in
// scene/scene.h).
LUXEL_FN vec2 environment_uv(vec3 direction, float rotation) {
    float c = cos(rotation), s = sin(rotation);
    float x = c * direction.x - s * direction.z, z = s * direction.x + c * direction.z;
    float u = 0.5f + atan(x, -z) / (2.0f * PI);
    float v = atan(sqrt(x * x + z * z), direction.y) / PI;
    return vec2(u - floor(u), v);
}

LUXEL_END
#endif
