// SPDX-License-Identifier: MIT
// The sum over virtual point lights at a surface point, and regions of pixels that share one sum.
#ifndef LUXEL_VPL_VPL_PARAMS_H
#define LUXEL_VPL_VPL_PARAMS_H
#include "techniques/common/vpl_params.h"
#include "techniques/vpl/ism_params.h"
LUXEL_BEGIN

struct VplGatherParams {
    ViewParams view;
    float bounded; // of the bounded kernel: 1: it ends at a light's area; 0: it does not
    float most;    // of it, 1/m2
    int level;     // of the regions that are shaded
    IsmParams ism;
};

// The part above the horizon of what a disc sends with the vector irradiance `arrow`, per flux / pi; c =
// n.arrow. By the sphere with the same vector, whose form factor facing it is F = |arrow| r^2 and the sine of
// whose radius is sigma = sqrt(F). While it crosses the horizon, t = cos / sigma in [-1, 1], u = (1 + t) / 2,
// a small sphere makes sigma^3 (t acos(-t) + (2 + t^2) sqrt(1 - t^2) / 3) / pi ~ sigma^3 u^2 (.7 + .3 u), one
// that fills a hemisphere u; weights between the two fit (asin sigma - sigma sqrt(1 - F)) / pi, which is
// exact for t = 0, to .03.
LUXEL_FN float disc_above_horizon(float c, float length2, float r2) {
    float size = sqrt(max(length2, 1e-30f)), f = min(size * r2, 1.0f), sigma = sqrt(f);
    float t = c / (size * sigma);
    if (t >= 1.0f) return c;
    float u = 0.5f + 0.5f * max(t, -1.0f), f2 = f * f, f4 = f2 * f2;
    return size * sigma * mix(u * u * (0.7f + 0.3f * u), u, 0.27f * f + 0.73f * f4 * f4);
}

// What flux / pi becomes as irradiance: of a disc with the light's area, in closed form while it is above the
// receiver's horizon. With h the receiver's height over its plane, a = d^2, s^2 = a - h^2, r^2 = bound and
// q^2 = (a + r^2)^2 - 4 r^2 s^2, the disc of radiance 1 makes pi/2 (1 - (a - r^2) / q) on a plane that faces
// it and pi h / (2 s) ((a + r^2) / q - 1) on one along its axis [Howell2010]. Both are differences of nearly
// equal numbers far away, hence the forms below. It is cos cos / d^2 for r = 0. plane: normal of the
// receiver's triangle. Both must be in front of each other by more than normals and positions are rounded:
// what is in the disc's own plane gets nothing, also if it is the other side of the same sheet.
LUXEL_CONST float VPL_COPLANAR = 0.002f; // sine of the angle; RGBA16F rounds normals by .0005
LUXEL_FN float vpl_disc_kernel(Vpl vpl, vec3 position, vec3 normal, vec3 plane) {
    vec3 v = vpl.position - position;
    float h = -dot(vpl.normal, v);
    float a = dot(v, v), r2 = vpl.bound;
    if (min(h, dot(plane, v)) <= VPL_COPLANAR * sqrt(a)) return 0.0f;
    float q = sqrt((a - r2) * (a - r2) + 4.0f * r2 * h * h);
    float facing = a > r2 ? 2.0f * h * h / (q * (q + a - r2)) : (q + r2 - a) / (2.0f * r2 * q);
    float aside = 2.0f * h / (q * (q + a + r2));
    vec3 arrow = v * aside + vpl.normal * (h * aside - facing); // irradiance as a vector, per flux / pi
    return disc_above_horizon(dot(normal, arrow), dot(arrow, arrow), r2);
}

// cos cos / (d^2 + bound): exact above the middle of a disc of that area, facing it; too dark in corners,
// where both cosines are 0 at the edge. [Le2014, 3.2.2.2] has a small constant, and cosines of backs and
// without a unit vector.
LUXEL_FN float vpl_bounded_kernel(Vpl vpl, vec3 position, vec3 normal, vec3 plane, VplGatherParams p) {
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
