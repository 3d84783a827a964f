// SPDX-License-Identifier: MIT
// Last pass of screen-space directional occlusion.
#ifndef LUXEL_SSDO_COMPOSE_PARAMS_H
#define LUXEL_SSDO_COMPOSE_PARAMS_H
#include "shared/glsl.h"
LUXEL_BEGIN

struct SsdoComposeParams {
    float scale; // full-size pixels per gathered pixel
};

LUXEL_END
#endif
