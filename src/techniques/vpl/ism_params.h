// SPDX-License-Identifier: MIT
// Imperfect shadow maps [Ritschel2008]: a paraboloid map of each virtual point light's hemisphere, drawn with
// points on the scene's surfaces. A texel holds 1/distance of the nearest, 0 where there is none.
#ifndef LUXEL_VPL_ISM_PARAMS_H
#define LUXEL_VPL_ISM_PARAMS_H
#include "shared/glsl.h"
LUXEL_BEGIN

struct IsmParams {
    int size;    // texels a side of each map
    int columns; // of maps in the image that holds them all
    int points;  // that each map is drawn with
    int sets;    // of so many points; maps take them in turn
};

// A point on a surface, in object space.
struct IsmPoint {
    vec3 position;
    uint instance;
    float radius; // of the disc that it stands for, m
    vec3 normal;  // of the triangle, not normalized; 0: no point
};

// From the unit hemisphere around +z to the unit disc, and back.
LUXEL_FN vec2 to_paraboloid(vec3 w) { return vec2(w.x, w.y) / (1.0f + max(w.z, 0.0f)); }
LUXEL_FN vec3 from_paraboloid(vec2 m) {
    float r2 = dot(m, m);
    return vec3(2.0f * m.x, 2.0f * m.y, 1.0f - r2) / (1.0f + r2);
}

// Angle under which a texel's side is seen at m, radians: |dw/dm| = 2 / (1 + m^2), times 2 / size.
LUXEL_FN float ism_texel(vec2 m, int size) { return 4.0f / (float(size) * (1.0f + dot(m, m))); }

LUXEL_FN ivec2 ism_corner(int light, IsmParams p) {
    return ivec2(light % p.columns, light / p.columns) * p.size;
}

LUXEL_END
#endif
