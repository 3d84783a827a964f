// SPDX-License-Identifier: MIT
// How the height fields of shared/height_field.h are searched.
#ifndef LUXEL_SHARED_HEIGHT_SEARCH_H
#define LUXEL_SHARED_HEIGHT_SEARCH_H
#include "shared/glsl.h"
LUXEL_BEGIN

// How a ray is searched: corrections of parallax mapping, or a linear search that is refined.
struct HeightSearch {
    int parallax_steps; // > 0: parallax mapping, and nothing of what follows the mode
    uint parallax_mode; // PARALLAX_*
    int linear_steps;   // equal steps until the first point below the field; 1: the whole depth
    int binary_steps;
    int secant_steps;
    float interpolates; // 1: the result is where the line between the last two points meets the ray; 0: their
                        // middle
    float moves_depth;  // 1: the frame's depth becomes that of the displaced surface; 0: it stays
};
LUXEL_CONST uint PARALLAX_PLAIN = 0u;
LUXEL_CONST uint PARALLAX_OFFSET_LIMIT = 1u;
LUXEL_CONST uint PARALLAX_SLOPE = 2u;
LUXEL_CONST uint PARALLAX_ITERATED = 3u;

LUXEL_END
#endif
