// SPDX-License-Identifier: MIT
// All surfaces that the pixels of a view meet, as one linked list for each pixel [Le2014, 3.3.2.1].
#ifndef LUXEL_COMMON_FRAGMENT_LISTS_PARAMS_H
#define LUXEL_COMMON_FRAGMENT_LISTS_PARAMS_H
#include "shared/glsl.h"
LUXEL_BEGIN

// Positions are relative to `center`.
struct ListView {
    mat4 to_pixel; // (x w, y w, z, w): pixel coordinates, linear depth, 1 or (perspective) the depth again
    vec3 center;   // world, m
    float near;    // of depth
    int side;      // pixels
    int levels;    // of the min-max pyramid
    float longest; // no ray of the scene is longer, m
    float pixel;   // its side where w = 1, m
};

struct ListCaptureParams {
    ListView view;
    mat4 world_to_clip;
    uint capacity; // nodes
};

struct ListLayerParams {
    int side;
    int layer;
};

// A fragment of a list: facet n.x = offset, seen through one pixel.
LUXEL_CONST uint LIST_OFFSET = 0u; // float bits; the thesis stores the depth at the pixel's center
LUXEL_CONST uint LIST_NORMAL = 1u; // pack_unit; outward, by the front side
LUXEL_CONST uint LIST_WHAT = 2u;   // instance and LIST_* flags
LUXEL_CONST uint LIST_NEXT = 3u;
// Node 0 is none: what an inactive lane of a CPU driver reads has to end a list as well.
LUXEL_CONST uint LIST_END = 0u;

// Which sides of a facet a ray can meet: a mirror's front; glass from outside or, for a ray in it, from
// inside.
LUXEL_CONST uint LIST_MIRROR = 0x80000000u;
LUXEL_CONST uint LIST_GLASS = 0x40000000u;
LUXEL_CONST uint LIST_INSTANCE = 0x3FFFFFFFu;

// Material of an instance, by its factors.
struct ListMaterial {
    vec3 f0;
    float ior; // signed_ior
    float f90;
    float roughness; // perceptual; 0 = an ideal mirror
};

LUXEL_END
#endif
