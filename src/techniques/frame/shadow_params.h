// SPDX-License-Identifier: MIT
// Shadow maps as shaders read them, and the maths of looking them up. Depth is reversed: 1 near, 0 far.
#ifndef LUXEL_FRAME_SHADOW_PARAMS_H
#define LUXEL_FRAME_SHADOW_PARAMS_H
#include "shared/light.h"
LUXEL_BEGIN

LUXEL_CONST uint SHADOW_HARD = 0u;
LUXEL_CONST uint SHADOW_PCF = 1u;
LUXEL_CONST uint SHADOW_ESM = 2u;

// One map: a face of a cube, a spot light's cone or a directional light's box.
struct ShadowView {
    mat4 world_to_map;
    vec3 right, up;    // unit axes of the map's plane
    vec2 half_texel;   // world size of half a texel along right and up at clip w = 1
    float near_by_far; // perspective: near / far; orthographic: 0
};

// A light with its maps: one, or the faces of a cube in the order +z, +x, -x, +y, -y, -z of `axes`.
struct ShadowedLight {
    Light light;
    mat3 axes; // columns; z = the light's direction
    uint first_map;
    uint maps;
};

// Which of the faces the direction d from the light meets.
LUXEL_FN uint cube_face(mat3 axes, vec3 d) {
    vec3 l = vec3(dot(axes[0], d), dot(axes[1], d), dot(axes[2], d));
    vec3 a = abs(l);
    if (a.z >= a.x && a.z >= a.y) return l.z > 0.0f ? 0u : 5u;
    if (a.x >= a.y) return l.x > 0.0f ? 1u : 2u;
    return l.y > 0.0f ? 3u : 4u;
}

// How far along its normal n a receiver must move so that its own plane cannot shadow it, when a lookup reads
// texels whose centers are up to `reach` half texels away on both axes. A plane's depth along the map's axis
// obeys n.(x, y, 1) z = c, c = distance of the plane from the light; half a texel (hx, hy) aside it changes
// by at most
// (|n.right| hx + |n.up| hy) z / |n.(x, y, 1)|, and moving the plane by d changes it by d / |n.(x, y, 1)|.
// Both sides share the divisor, so that the offset needs no slope limit: it is at most `reach` texel
// diagonals / 2. w: clip w of the receiver (its depth; 1 for orthographic maps).
LUXEL_FN float receiver_offset(ShadowView view, vec3 n, float w, float reach) {
    return reach * w *
           (abs(dot(n, view.right)) * view.half_texel.x + abs(dot(n, view.up)) * view.half_texel.y);
}

// Half texels that each filter reaches: a nearest texel's center is 1 away and bilinear ones 2; the PCF
// kernel spans 2 texels to either side. The rasterizer's sub-pixel grid (1/256 texel) moves edges by another
// 1/128.
LUXEL_FN float shadow_reach(uint mode) {
    if (mode == SHADOW_HARD) return 1.0f + 1.0f / 128.0f;
    return (mode == SHADOW_ESM ? 2.0f : 4.0f) + 1.0f / 128.0f;
}

// Rounding of a depth in [0, 1] by the rasterizer: a plane equation's few ulps at 1.
LUXEL_CONST float DEPTH_ROUNDING = 4.8e-7f; // 2^-21

// Linear light depth in [0, 1] of a reversed depth, as exponential shadow maps compare it.
LUXEL_FN float linear_light_depth(ShadowView view, float reversed) {
    if (view.near_by_far == 0.0f) return 1.0f - reversed;
    return min(view.near_by_far / max(reversed, 1e-30f), 1.0f);
}

// Weights of the 4 texels of one axis under a box of 3 texels with a bilinear edge; f = position between the
// two middle ones. They sum to 1.
LUXEL_FN vec4 pcf_weights(float f) { return vec4(1.0f - f, 1.0f, 1.0f, f) / 3.0f; }

// Visibility behind an exponential shadow map: r receiver, o (filtered) occluder, c exponent, cos_theta =
// saturate(n.l) [Rohleder2010, eq. 30 and listing 8].
LUXEL_FN float esm_visibility(float r, float o, float c, float cos_theta) {
    return exp(-c * max(r - o, 0.0f) * cos_theta);
}

// One step of a log-space sum: log(exp(a) + w exp(b)) relative to the running maximum [Salvi2008].
struct LogSum {
    float largest; // exponent of the largest term so far
    float sum;     // of weight * exp(term - largest)
};
LUXEL_FN LogSum log_add(LogSum s, float term, float weight) {
    float largest = max(s.largest, term);
    s.sum = s.sum * exp(s.largest - largest) + weight * exp(term - largest);
    s.largest = largest;
    return s;
}

LUXEL_END
#endif
