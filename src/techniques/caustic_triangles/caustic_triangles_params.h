// SPDX-License-Identifier: MIT
#ifndef LUXEL_CAUSTIC_TRIANGLES_PARAMS_H
#define LUXEL_CAUSTIC_TRIANGLES_PARAMS_H
#include "techniques/common/caustics_params.h"
LUXEL_BEGIN

LUXEL_CONST uint CAUSTIC_RIM_SPLAT = 0u;   // splatted
LUXEL_CONST uint CAUSTIC_RIM_FLUX = 1u;    // drawn ones get it
LUXEL_CONST uint CAUSTIC_RIM_DENSITY = 2u; // lost

struct CausticAreaParams {
    int photons; // a side of the photon image
    int size;    // texels a side of the caustic cube map
    float tear;  // share of its distance that the middle of a triangle may be off the surface
    float least; // texels below which a triangle is not drawn
    float share; // of the adjacent triangles' areas that is a photon's own: 1/3
    uint rim;    // CAUSTIC_RIM_*: what becomes of the light of triangles that are not drawn
};

// Corner c of triangle t of the square whose first pixel is q.
LUXEL_FN ivec2 caustic_corner(ivec2 q, int t, int c) {
    if (t == 0) return q + ivec2(c == 1 ? 1 : 0, c == 2 ? 1 : 0);
    return q + ivec2(c == 1 ? 0 : 1, c == 2 ? 0 : 1);
}

LUXEL_END
#endif
