// SPDX-License-Identifier: MIT
// Virtual point lights drawn by what they send to a few visible points.
#ifndef LUXEL_VPL_IMPORTANCE_PARAMS_H
#define LUXEL_VPL_IMPORTANCE_PARAMS_H
#include "techniques/vpl/vpl_params.h"
LUXEL_BEGIN

struct VplEyeParams {
    ViewParams view;
    int points;
};

struct VplImportanceParams {
    int points;
    IsmParams ism; // of the visible points
};

struct VplResampleParams {
    int wanted;
    float by_flux; // share of them that is drawn by flux alone
};

LUXEL_CONST uint VPL_RESAMPLE_LANES = 256u;

// How often systematic sampling with steps of 1/wanted draws what covers [from, to) of the unit interval.
LUXEL_FN int times_drawn(float from, float to, int wanted) {
    return int(floor(to * float(wanted) + 0.5f)) - int(floor(from * float(wanted) + 0.5f));
}

LUXEL_END
#endif
