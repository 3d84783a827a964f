// SPDX-License-Identifier: MIT
// The sum over virtual point lights at a surface point, and regions of pixels that share one sum.
#ifndef LUXEL_VPL_VPL_PARAMS_H
#define LUXEL_VPL_VPL_PARAMS_H
#include "techniques/common/vpl_params.h"
LUXEL_BEGIN

struct VplGatherParams {
    ViewParams view;
    float bounded; // 1: the kernel ends at a light's area; 0: it does not
    float most;    // of the kernel, 1/m2
    int level;     // of the regions that are shaded
};

// cos cos / (d^2 + bound), with `plane` the receiver's triangle: what flux / pi becomes as irradiance. bound
// = area / pi makes it exact for a disc of that area seen from above its middle, and lets the bias vanish
// with the area; [Le2014, 3.2.2.2] has a small constant. The cosines are those of unit vectors, and not of
// their backs, other than printed there.
LUXEL_FN float vpl_kernel(Vpl vpl, vec3 position, vec3 normal, vec3 plane, VplGatherParams p) {
    vec3 v = vpl.position - position;
    float d2 = max(dot(v, v), 1e-12f);
    if (dot(plane, v) <= 0.0f) return 0.0f;
    float cosines = max(dot(normal, v), 0.0f) * max(-dot(vpl.normal, v), 0.0f) / d2;
    return min(cosines / (d2 + vpl.bound * p.bounded), p.most);
}

// As printed, without 1/pi [Le2014, 3.2.2.2]; the thesis names no epsilon.
LUXEL_CONST float VPL_THESIS_EPSILON = 1e-3f; // m2
LUXEL_FN float vpl_thesis_kernel(Vpl vpl, vec3 position, vec3 normal) {
    vec3 v = vpl.position - position;
    return abs(dot(normal, v)) * abs(dot(vpl.normal, v)) / (dot(v, v) + VPL_THESIS_EPSILON);
}

struct VplRegionParams {
    ViewParams view;
    int level, coarsest;
    float depth_step;  // least discontinuity of depth, as a share of it
    float normal_step; // least discontinuity of any component of the normal
};

// What a region's pixels span. Depth 0: nothing is seen.
struct SurfaceRange {
    vec3 least_normal, most_normal;
    float least_depth, most_depth;
};

// Both differences only grow towards coarser levels and the bounds do not, so that a region without a
// discontinuity has no part with one, and squares beside it no part that is beside one: each pixel is in one
// valid region [Le2014, 3.2.2.1].
LUXEL_FN bool is_discontinuous(SurfaceRange r, float depth_step, float normal_step) {
    vec3 n = r.most_normal - r.least_normal;
    return r.most_depth - r.least_depth > depth_step * r.least_depth || max(max(n.x, n.y), n.z) > normal_step;
}

LUXEL_END
#endif
