// SPDX-License-Identifier: MIT
// What all estimators of the occlusion slot share: their receiver, their taps' pixels, their filter.
#ifndef LUXEL_OCCLUSION_PARAMS_H
#define LUXEL_OCCLUSION_PARAMS_H
#include "shared/glsl.h"
LUXEL_BEGIN

LUXEL_CONST int OCCLUSION_MAX_SAMPLES = 64;

// First member of every estimator's own parameter struct. The buffers may be smaller than the frame by
// `step`: pixel q of them holds what pixel q * step of the frame holds, nothing is averaged. Camera space: x
// right, y up, z = linear depth, meters. Pixel q sees along (q * ray_scale + ray_offset, 1).
struct OcclusionParams {
    vec4 world_to_camera; // quaternion of the rotation to x right, y up, -z forward
    float radius;         // R, meters
    float thickness;      // meters along the ray that a visible surface is taken to be solid behind its front
    int samples;
    vec2 ray_scale;
    vec2 ray_offset;
    ivec2 size;       // pixels of the buffers
    int step;         // frame pixels per pixel
    uint interleaved; // 1 = each pixel of a 4x4 block turns the taps differently
};

// A box of 4 pixels along one axis; two of them, x then y, cover each pixel of the 4x4 pattern once.
struct OcclusionFilterParams {
    ivec2 direction; // (1, 0) or (0, 1)
    float limit;     // meters of depth off the plane through the pixel and its neighbor
};

struct OcclusionUpsampleParams {
    ivec2 size; // of the frame
    float step;
};

// Place of a pixel in the pattern, 0..15, such that neighbors and the rows and columns of a block are spread
// over the range (ordered dithering, bits of x ^ y and y interleaved from coarse to fine).
LUXEL_FN int pattern_index(ivec2 pixel) {
    int x = pixel.x & 3;
    int y = pixel.y & 3;
    int d = x ^ y;
    return ((d & 1) << 3) | ((y & 1) << 2) | (d & 2) | ((y & 2) >> 1);
}

// Unit vector of the pattern in the plane: sixteen even turns.
LUXEL_FN vec2 pattern_turn(int index) {
    float angle = 2.0f * PI * float(index) / 16.0f;
    return vec2(cos(angle), sin(angle));
}

// Unit vector of the pattern on the half sphere: a Fibonacci spiral.
LUXEL_FN vec3 pattern_direction(int index) {
    float z = (float(index) + 0.5f) / 16.0f;
    float r = sqrt(1.0f - z * z);
    float phi = 2.39996323f * float(index);
    return vec3(r * cos(phi), r * sin(phi), z);
}

LUXEL_END
#endif
