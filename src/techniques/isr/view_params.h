// SPDX-License-Identifier: MIT
// Image-space radiosity from further views: additional cameras, a hidden layer, earlier frames.
#ifndef LUXEL_ISR_VIEW_PARAMS_H
#define LUXEL_ISR_VIEW_PARAMS_H
#include "techniques/isr/isr_params.h"
LUXEL_BEGIN

struct IsrPeelParams {
    float separation; // relative
};

// Which pixels of an additional camera the frame's patches do not stand for already.
struct IsrUnseenParams {
    ViewParams view, camera; // the frame's; the additional one
    ivec2 origin, patches;   // as IsrParams
    float scale;             // as IsrParams
    float tolerance;         // relative difference of depth of what is the same surface
};

struct IsrCameraParams {
    ViewParams view, camera;
    uint width, height; // of the coarse frame
    float scale;
    float turn, shift; // as IsrParams
    int taps;
};

struct IsrTemporalParams {
    ViewParams view, before; // of this frame and of the one that the history is of
    float scale;
    float frames;    // that the history holds at most
    float tolerance; // distance from the surface's plane at which history is rejected, relative to depth
    float least_cos; // between normals, below which it is rejected
};

// Points that fill the unit square evenly, however many are taken [Roberts2018].
LUXEL_FN vec2 isr_even_point(int i, float turn, float shift) {
    return vec2(fract(turn + 0.75487766f * float(i)), fract(shift + 0.56984029f * float(i)));
}

// Projected solid angle of a tap that stands for `share` patches such as the one it met: the disc of all of
// them bounds it, so that no tap counts for more than a hemisphere.
LUXEL_FN float shared_solid_angle(vec3 normal_p, vec3 to_patch, vec3 area_vector, float share) {
    return projected_solid_angle(normal_p, to_patch, area_vector * share);
}

LUXEL_END
#endif
