// SPDX-License-Identifier: MIT
// Photons that specular objects send to what is around them, and the cube map that collects them.
#ifndef LUXEL_COMMON_CAUSTICS_PARAMS_H
#define LUXEL_COMMON_CAUSTICS_PARAMS_H
#include "shared/cube.h"
#include "shared/light.h"
#include "techniques/common/cube_trace_params.h"
#include "techniques/frame/view_params.h"
LUXEL_BEGIN

struct CausticPhotonParams {
    ViewParams view; // from the light; a directional light's is from afar
    CubeTraceParams cube;
    CubeObjects objects;
    Light light;
    uint mirrored; // 1 = photons that glass reflects first; 0 = the stronger branch at each surface
};

// Texels that a splat is never wider than for the area that it covers.
LUXEL_CONST float CAUSTIC_WIDEST = 32.0f;

// One face of the caustic cube map, as raster passes see it.
struct CausticFaceParams {
    mat4 to_clip; // from positions relative to the center
    int face;
    int size;     // texels a side
    float radius; // of a splat, texels, at least
    int photons;  // a side of the photon image
};

struct CausticReceiveParams {
    ViewParams view;
    vec3 center;
    float texel; // of the distance map, radians
};

// Area on a surface with normal n that a texel of solid angle `solid` shows in the direction of p, m2.
LUXEL_FN float texel_area(vec3 p, vec3 n, float solid) {
    float d = length(p);
    return solid * d * d / max(abs(dot(p / d, n)), 0.05f);
}

LUXEL_END
#endif
