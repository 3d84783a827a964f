// SPDX-License-Identifier: MIT
// Impostors as shaders read them: rectangles in the world with samples of the object behind them.
#ifndef LUXEL_FRAME_IMPOSTOR_PARAMS_H
#define LUXEL_FRAME_IMPOSTOR_PARAMS_H
#include "shared/glsl.h"
LUXEL_BEGIN

// A part of an image of samples, seen from `eye`, and the rectangle that shows it.
struct ImpostorCard {
    vec3 corner;         // world, of the part's first texel
    vec3 edge_u, edge_v; // along a row of texels, along a column
    vec2 first, size;    // the part, texels
    vec3 eye;            // where the samples were seen from
    vec3 forward;        // unit, along which their depth is measured
    float depth;         // of the rectangle, the same way
    mat3 turn;           // of the samples' normals into the world
    float parallel;      // 1: seen along `forward`, the eye is anywhere on the plane of depth 0
};

// The point that a sample of depth z stands for, where `on_card` is a point of the rectangle: both are seen
// in one direction from the card's eye [Schaufler1997].
LUXEL_FN vec3 card_sample(ImpostorCard card, vec3 on_card, float z) {
    vec3 ray = card.parallel > 0.5f ? card.forward * card.depth : on_card - card.eye;
    return on_card + ray * (z / card.depth - 1.0f);
}

// Where the rectangle's plane shows a point of the object; not for parallel ones.
LUXEL_FN vec3 shown_on_card(ImpostorCard card, vec3 point) {
    vec3 ray = point - card.eye;
    return card.eye + ray * (card.depth / dot(ray, card.forward));
}

LUXEL_END
#endif
