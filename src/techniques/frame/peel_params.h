// SPDX-License-Identifier: MIT
// Parameters of the G-buffer passes that leave surfaces out.
#ifndef LUXEL_FRAME_PEEL_PARAMS_H
#define LUXEL_FRAME_PEEL_PARAMS_H
#include "techniques/frame/view_params.h"
LUXEL_BEGIN

// Begins with what the other G-buffer passes have. drop_*: 1 = left out, 0 = drawn. Numbers instead of flags:
// lavapipe builds a shader for each value that a branch depends on.
struct PeelParams {
    ViewParams view;
    float drop_front, drop_back;
    float drop_solid_back; // of single-sided surfaces
    // 1: only what covers a part of its pixel, 0: only what covers all of it. 2: as 1, and nothing where
    // farther_than has nothing: the layer before was the last.
    float blended;
};

LUXEL_END
#endif
