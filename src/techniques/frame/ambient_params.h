// SPDX-License-Identifier: MIT
// Irradiance of the environment by spherical harmonics [Ramamoorthi2001].
#ifndef LUXEL_FRAME_AMBIENT_PARAMS_H
#define LUXEL_FRAME_AMBIENT_PARAMS_H
#include "shared/glsl.h"
LUXEL_BEGIN

// Radiance coefficients in the order of project_environment_sh (scene/lights.h).
struct AmbientParams {
    vec3 sh[9];
};

// Irradiance on a plane with unit normal n: the basis functions times pi, 2 pi/3, pi/4 for bands 0, 1, 2
// [Ramamoorthi2001, eq. 8]. Clamped: three bands can ring below zero.
LUXEL_FN vec3 sh_irradiance(AmbientParams p, vec3 n) {
    vec3 band0 = p.sh[0] * 0.2820948f;
    vec3 band1 = (p.sh[1] * n.y + p.sh[2] * n.z + p.sh[3] * n.x) * 0.4886025f;
    vec3 band2 = (p.sh[4] * (n.x * n.y) + p.sh[5] * (n.y * n.z) + p.sh[7] * (n.x * n.z)) * 1.0925484f +
                 p.sh[6] * (0.3153916f * (3.0f * n.z * n.z - 1.0f)) +
                 p.sh[8] * (0.5462742f * (n.x * n.x - n.y * n.y));
    return max(band0 * PI + band1 * (2.0f * PI / 3.0f) + band2 * (PI / 4.0f), vec3(0.0f));
}

// Radiance that arrives from the unit direction d. Not clamped: its integral over a hemisphere is
// sh_irradiance.
LUXEL_FN vec3 sh_radiance(AmbientParams p, vec3 d) {
    return p.sh[0] * 0.2820948f + (p.sh[1] * d.y + p.sh[2] * d.z + p.sh[3] * d.x) * 0.4886025f +
           (p.sh[4] * (d.x * d.y) + p.sh[5] * (d.y * d.z) + p.sh[7] * (d.x * d.z)) * 1.0925484f +
           p.sh[6] * (0.3153916f * (3.0f * d.z * d.z - 1.0f)) +
           p.sh[8] * (0.5462742f * (d.x * d.x - d.y * d.y));
}

LUXEL_END
#endif
