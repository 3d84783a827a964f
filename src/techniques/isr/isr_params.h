// SPDX-License-Identifier: MIT
// Image-space radiosity: what C++ and the shaders share, and the estimator itself.
#ifndef LUXEL_ISR_PARAMS_H
#define LUXEL_ISR_PARAMS_H
#include "shared/glsl.h"
#include "techniques/frame/view_params.h"
LUXEL_BEGIN

LUXEL_CONST uint ISR_CALIBRATED = 0u;
LUXEL_CONST uint ISR_THESIS = 1u;
LUXEL_CONST int ISR_MAX_TAPS = 512;

// The gather. Receivers are the coarse pixels of the frame; patches may reach beyond its border.
struct IsrParams {
    ViewParams view;         // of the full-size frame
    uint width, height;      // of the coarse frame
    ivec2 origin;            // where its first pixel lies among the patches
    ivec2 patches;           // size of the image of patches
    float scale;             // full-size pixels per coarse pixel
    float pixel_area;        // of a coarse pixel on the plane at distance 1, m2
    float nearest, farthest; // depth of the receivers that this pass is for, (nearest, farthest], m
    float turn, shift;       // added to every pixel's jitter, [0, 1)
    uint mode;               // ISR_*
    int taps;
    float radius;       // of the kernel, coarse pixels
    float inner_radius; // of the excluded disc around the receiver, coarse pixels
    float grazing;      // least |cos| between a patch's normal and the view ray
    float ao_radius;    // meters; occluders beyond it do not count
    float spacing;      // thesis: coarse pixels between the radiosity offsets
    float ao_stride;    // thesis: occlusion offsets relative to the radiosity offsets
    float occluder;     // thesis: radius of the occluding spheres, coarse pixels
};

// From a capture to patches.
struct IsrPatchParams {
    ViewParams view;       // of the capture
    uint width, height;    // of the coarse pixels that it is divided into
    float scale;           // pixels of the capture per coarse pixel, 1 or 2
    float pixel_area;      // as above
    float grazing;         // as above
    uint mode;             // ISR_*
    ivec2 origin;          // where the first coarse pixel is written to
    ivec2 hole, hole_size; // coarse pixels that are left out
};

struct IsrReflectParams {
    ivec2 origin; // as IsrParams
};

// A coarse pixel as a patch of the scene: its normal times its area, m2.
// A_x = a z^3 / |n.P_view| with P_view = z d, d the pixel ray whose component along the view direction is 1.
LUXEL_FN vec3 patch_area_vector(vec3 normal, vec3 pixel_ray, float z, float pixel_area, float grazing) {
    float slope = max(abs(dot(normal, pixel_ray)), grazing * length(pixel_ray));
    return normal * (pixel_area * z * z / slope);
}

// Depth of a position along a view's axis, and the pixel coordinate where the view sees it (centers at .5).
// The inverse of world_position; the pixel is meaningless where the depth is not positive.
struct IsrProjection {
    vec2 pixel;
    float depth;
};
LUXEL_FN IsrProjection isr_project(ViewParams v, vec3 position) {
    vec3 d = position - v.position;
    IsrProjection r;
    r.depth = dot(d, v.forward);
    float s = 1.0f / max(r.depth, 1e-20f);
    r.pixel = vec2(v.width * 0.5f * (1.0f + dot(d, v.right) / dot(v.right, v.right) * s),
                   v.height * 0.5f * (1.0f - dot(d, v.up) / dot(v.up, v.up) * s));
    return r;
}

// cos_p cos_x A_x / (r^2 + A_x/pi): the patch's projected solid angle as seen from p (the disc bound keeps
// adjacent patches finite). `to_patch` runs from p to x, meters.
LUXEL_FN float projected_solid_angle(vec3 normal_p, vec3 to_patch, vec3 area_vector) {
    float r2 = dot(to_patch, to_patch);
    float cos_p = max(dot(normal_p, to_patch), 0.0f);
    float cos_x_area = max(-dot(area_vector, to_patch), 0.0f);
    return cos_p * cos_x_area / max(r2 * (r2 + length(area_vector) / PI), 1e-20f);
}

// Log-polar tap table: radii grow geometrically from inner to outer radius, angles by the golden angle, so
// that each octave of distance, which carries about the same irradiance, gets the same number of taps.
// `shift` in [0, 1) moves the radius, `turn` rotates: the pixel's place in its 4x4 block.
struct IsrTap {
    vec2 offset;  // coarse pixels
    float weight; // coarse pixels that the tap stands for: 1/(N density), density 1/(2 pi r^2 ln(R/r0)) per
                  // pixel
};
LUXEL_FN IsrTap log_polar_tap(int i, int count, float inner, float outer, float shift, float turn) {
    float span = log(outer / inner);
    float r = inner * exp(span * (float(i) + shift) / float(count));
    float angle = 2.39996323f * float(i) + 2.0f * PI * turn;
    IsrTap tap;
    tap.offset = vec2(r * cos(angle), r * sin(angle));
    tap.weight = 2.0f * PI * r * r * span / float(count);
    return tap;
}

// How a pixel turns the tap table and moves its radii, both in [0, 1): additive recurrences in x and y, so
// that the pixels under the blur's kernel cover both evenly. [Roberts2018] for the turn, [Jimenez2014] for
// the shift.
struct IsrJitter {
    float turn, shift;
};
LUXEL_FN IsrJitter isr_jitter(vec2 pixel) {
    IsrJitter j;
    j.turn = fract(0.75487766f * pixel.x + 0.56984029f * pixel.y);
    j.shift = fract(52.9829189f * fract(0.06711056f * pixel.x + 0.00583715f * pixel.y));
    return j;
}

LUXEL_END
#endif
