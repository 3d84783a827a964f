// SPDX-License-Identifier: MIT
// Separable Gaussian blur, optionally stopped at edges of depth and normal.
#ifndef LUXEL_BLUR_PARAMS_H
#define LUXEL_BLUR_PARAMS_H
#include "shared/glsl.h"
LUXEL_BEGIN

struct BlurParams {
    ivec2 direction;       // (1, 0) or (0, 1)
    int radius;            // pixels
    float sigma;           // pixels
    float depth_tolerance; // relative depth difference per pixel that halves a weight; 0 = plain Gaussian
};

// Weight of a neighbor at relative depth difference `dz`, `pixels` away, whose normals enclose `cos_n`.
LUXEL_FN float edge_weight(float dz, float pixels, float cos_n, float depth_tolerance) {
    float t = dz / (depth_tolerance * max(pixels, 1.0f));
    float c = max(cos_n, 0.0f);
    float c2 = c * c;
    return c2 * c2 / (1.0f + t * t);
}

LUXEL_END
#endif
