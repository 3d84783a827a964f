// SPDX-License-Identifier: MIT
// Parameters of the pass that turns a capture into a face of a distance cube.
#ifndef LUXEL_COMMON_DISTANCE_CUBE_PARAMS_H
#define LUXEL_COMMON_DISTANCE_CUBE_PARAMS_H
#include "shared/brdf.h"
LUXEL_BEGIN

struct CubeFaceParams {
    int face;
    int size;         // texels a side
    float background; // distance where nothing is seen, m
    float environment_rotation;
    float environment_scale; // 0 = black
};

// rgb: albedo, or reflectance at normal incidence; a: as DistanceCube::material. ior: signed_ior.
LUXEL_FN vec4 cube_material(vec3 diffuse, vec3 f0, float ior) {
    if (ior == 0.0f) return vec4(diffuse, 0.0f);
    if (ior < 0.0f) return vec4(f0, ior);
    // Transmission has taken its share out of the lobes.
    bool thin = ior > THIN_IOR;
    float n = thin ? ior - THIN_IOR : ior;
    float r = (n - 1.0f) / (n + 1.0f);
    return vec4(vec3(r * r), thin ? 1.0f : n);
}

LUXEL_END
#endif
