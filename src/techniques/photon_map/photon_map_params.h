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
    float beam;      // its cross section is beam x travelled^2, or (parallel) beam, had nothing focused it
    uint parallel;
    uint key;             // of its random numbers: the same in each frame, whatever the order of the photons
    uint differential;    // 1 = the neighbors' rays are known, on the first ray
    vec3 place_x, turn_x; // how position and direction change to a neighbor; of one that arrived: place_x and
    vec3 place_y, turn_y; // place_y span what its part of the beam lights
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

struct PhotonPickParams {
    int most; // photons
    int levels;
    uint mixed; // 1 = cells that are specular in part send photons, too
};

// Cells of one shadow map that send a photon each; the cells follow, x + y 2^16. Filled with ones at first.
LUXEL_CONST uint PHOTON_GROUP = 64u;
struct PickedCells {
    uvec3 groups; // of the dispatch over them
    uint end;     // their number + 1
    int level;
};

struct PhotonEmitParams {
    ViewParams view; // of the reflective shadow map
    Light light;
    vec3 center;  // of the lists
    int capacity; // photons in the buffer
    uint seed;
    uint differential; // 1 = photons know their neighbors' rays
    uint both;         // 1 = glass reflects and refracts, 0 = one of them by chance
};

struct PhotonTraceParams {
    ListView view;
    float start;         // pixels that a ray is ahead of where it began
    int first_row, rows; // of the image of lines
    int most;
};

struct PhotonScatterParams {
    ListView view;
    uint last; // 1 = no bounce is left
    uint bounce, seed;
    int most;
};

struct PhotonSplatParams {
    ViewParams view; // of the frame, at the splats' resolution
    vec3 center;
    float reach;       // radii of a disc over what the photon's part of the beam lights
    float reach_beam;  // where its neighbors are not known
    float least;       // radius, pixels
    float most_radius; // m
    float delta;       // of the Gaussian
    float shift;     // from a coarse pixel's center to that of the frame's pixel that it shows, coarse pixels
    vec2 frame_size; // pixels
    vec2 share;      // of the image's width and height that the frame covers: its last coarse pixels are cut
};

LUXEL_CONST float LEAST_COSINE = 0.1f; // of arriving light: discs grow no more

// Kernels of discs whose axes are the unit vectors of u and v, times the axes' parallelogram: energy per
// area. Their integral over the disc is 1: the thesis's cone keeps a third [Le2014, 3.3.2.3].
LUXEL_FN float photon_cone(float u, float v) { return 3.0f / PI * max(1.0f - sqrt(u * u + v * v), 0.0f); }
LUXEL_FN float photon_gaussian(float u, float v, float delta) {
    float q2 = u * u + v * v;
    if (q2 > 1.0f) return 0.0f;
    return exp(-q2 / (2.0f * delta)) / (2.0f * PI * delta * (1.0f - exp(-1.0f / (2.0f * delta))));
}
// Between neighbors it interpolates linearly: on a regular grid of photons tents add up to a constant.
LUXEL_FN float photon_tent(float u, float v) { return max(1.0f - abs(u), 0.0f) * max(1.0f - abs(v), 0.0f); }

LUXEL_END
#endif
