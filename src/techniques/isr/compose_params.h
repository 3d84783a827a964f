// SPDX-License-Identifier: MIT
// Last pass of image-space radiosity.
#ifndef LUXEL_ISR_COMPOSE_PARAMS_H
#define LUXEL_ISR_COMPOSE_PARAMS_H
#include "techniques/isr/isr_params.h"
LUXEL_BEGIN

struct IsrComposeParams {
    float scale;         // full-size pixels per coarse pixel
    uint mode;           // ISR_*
    float k_isr, k_ssao; // thesis only [Rohleder2010, eq. 29]
};

LUXEL_END
#endif
