// SPDX-License-Identifier: MIT
// Bent normals: from the pattern's pixels to the frame's.
#ifndef LUXEL_GTAO_BENT_PARAMS_H
#define LUXEL_GTAO_BENT_PARAMS_H
#include "shared/glsl.h"
LUXEL_BEGIN

struct GtaoBentParams {
    vec3 right; // of the camera, unit
    int step;   // frame pixels per estimated pixel
    vec3 up;
    float limit; // relative depth difference beyond which pixels are left out
    vec3 forward;
};

LUXEL_END
#endif
