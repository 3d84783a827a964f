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

// Each uniform in [0, 1) over the pixels, evenly so in every neighborhood: the additive recurrence of the
// plastic number [Roberts2018], shifted by a hash of `surface`.
LUXEL_FN MaskThresholds mask_thresholds(uint x, uint y, uint surface) {
    uint sequence = x * 3242174889u + y * 2447445413u;
    MaskThresholds t;
    t.coverage = uniform_float(sequence + pcg(surface));
    t.level = uniform_float(pcg(sequence ^ pcg(surface + 0x9e3779b9u)));
    return t;
}

LUXEL_END
#endif
