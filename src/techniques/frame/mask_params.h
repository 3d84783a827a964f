// SPDX-License-Identifier: MIT
// Which pixels of a partly covered surface stay.
#ifndef LUXEL_FRAME_MASK_PARAMS_H
#define LUXEL_FRAME_MASK_PARAMS_H
#include "shared/glsl.h"
#include "shared/random.h"
LUXEL_BEGIN

struct MaskThresholds {
    float coverage; // a pixel stays where more than this is covered
    float level;    // of mips, between 0 and 1: coverage is looked at above it
};

// Each uniform in [0, 1) over the pixels. Within 4 x 4 of them coverage is even: the additive recurrence of
// the plastic number [Roberts2018], shifted by a hash of the square and of `surface`, so that two surfaces
// are independent over a few squares already.
LUXEL_FN MaskThresholds mask_thresholds(uint x, uint y, uint surface) {
    MaskThresholds t;
    t.coverage = uniform_float(x * 3242174889u + y * 2447445413u + hash3(x >> 2u, y >> 2u, surface));
    t.level = uniform_float(hash3(x, y, surface ^ 0x9e3779b9u));
    return t;
}

LUXEL_END
#endif
