// SPDX-License-Identifier: MIT
// Photons on their way from the first specular surface to a diffuse one.
#ifndef LUXEL_PHOTON_MAP_PARAMS_H
#define LUXEL_PHOTON_MAP_PARAMS_H
#include "shared/light.h"
#include "techniques/common/fragment_lists_params.h"
#include "techniques/frame/view_params.h"
LUXEL_BEGIN

LUXEL_CONST uint PHOTON_FLYING = 0u;
LUXEL_CONST uint PHOTON_ARRIVED = 1u; // at a diffuse surface
LUXEL_CONST uint PHOTON_LOST = 2u;    // out of the capture, or between specular surfaces for too long

// Positions are relative to the center of the lists.
struct Photon {
    vec3 position; // where the ray starts; where it arrived
    uint state;
    vec3 direction;  // unit; of one that arrived: the surface's normal, on the side that it came from
    uint inside;     // 1 = of glass
    vec3 power;      // W
    float travelled; // m from the light
    float beam;      // its cross section is beam x travelled^2, or (parallel) beam; of one that arrived: the
                     // area that it would light, had nothing focused it, m2
    uint parallel;
};

// How a photon's ray ended.
struct PhotonHit {
    float t;
    int node;          // -1: nothing met
    uint cells, nodes; // visited
};

// Buffer of counts: photons, then non-empty cells of each level of the flux pyramids.
LUXEL_CONST int PHOTON_COUNT = 0;
LUXEL_CONST int PHOTON_LEVELS = 1;
LUXEL_CONST int PHOTON_MAX_LEVELS = 14;

struct PhotonFluxParams {
    int level;
};

struct PhotonEmitParams {
    ViewParams view; // of the reflective shadow map
    Light light;
    vec3 center;  // of the lists
    int most;     // photons
    int capacity; // of the buffer
    int levels;
    uint seed;
    uint both;  // 1 = glass reflects and refracts, 0 = one of them by chance
    uint mixed; // 1 = cells that are specular in part send photons, too
};

struct PhotonTraceParams {
    ListView view;
    float start;         // pixels that a ray is ahead of where it began
    int first_row, rows; // of the image of lines
    int most;
};

struct PhotonScatterParams {
    vec3 center;
    uint last; // 1 = no bounce is left
    uint bounce, seed;
    int most;
};

struct PhotonSplatParams {
    ViewParams view; // of the frame, at the splats' resolution
    vec3 center;
    float share; // photons that a disc holds where the beam is as wide as it left
    float least; // radius, pixels
    float delta; // of the Gaussian
    int most;
};

LUXEL_CONST float LEAST_COSINE = 0.1f; // of arriving light: discs grow no more

// Energy that a disc of radius h holds at distance r from its center, per area [Le2014, 3.3.2.3], scaled so
// that the integral over the disc is 1: the thesis's cone keeps a third.
LUXEL_FN float photon_cone(float r, float h) { return 3.0f / (PI * h * h) * max(1.0f - r / h, 0.0f); }
LUXEL_FN float photon_gaussian(float r, float h, float delta) {
    if (r > h) return 0.0f;
    float q = r / h;
    return exp(-q * q / (2.0f * delta)) / (2.0f * PI * delta * h * h * (1.0f - exp(-1.0f / (2.0f * delta))));
}

LUXEL_END
#endif
