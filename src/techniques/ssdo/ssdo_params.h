// SPDX-License-Identifier: MIT
// Screen-space directional occlusion: what C++ and the shaders share, and the geometry of its rays.
#ifndef LUXEL_SSDO_PARAMS_H
#define LUXEL_SSDO_PARAMS_H
#include "shared/glsl.h"
#include "shared/sampling.h"
#include "techniques/frame/ambient_params.h"
#include "techniques/frame/view_params.h"
LUXEL_BEGIN

struct SsdoParams {
    ViewParams view;
    AmbientParams environment; // black where the frame's environment is not `ambient`
    uint width, height;        // of the gathered image
    int scale;                 // full-size pixels per gathered pixel, 1 or 2
    int samples;               // directions
    int steps;                 // points along each
    float radius;              // meters
    float thickness;           // an occluder's depth behind what is seen, over its distance from the receiver
};

// Where a world position falls in the image: (pixel x, pixel y, 1) times its depth, so that the points of a
// ray are a linear function of their distance.
LUXEL_FN vec3 homogeneous_pixel(ViewParams v, vec3 position) {
    vec3 d = position - v.position;
    float z = dot(d, v.forward);
    float x = dot(d, v.right) / dot(v.right, v.right), y = dot(d, v.up) / dot(v.up, v.up);
    return vec3((z + x) * 0.5f * v.width, (z - y) * 0.5f * v.height, z);
}

// The full-size pixel that stands for a gathered one: at half size one of the block's diagonal, by turns, so
// that their mean place is the block's center.
LUXEL_FN vec2 full_pixel(vec2 gathered, int scale) {
    if (scale == 1) return gathered;
    float turn = fract((gathered.x + gathered.y) * 0.5f) * 2.0f;
    return gathered * 2.0f + vec2(turn);
}

// Three numbers in [0, 1) for a pixel, low-discrepant over its neighbors: [Jimenez2014] and two additive
// recurrences [Roberts2018].
LUXEL_FN vec3 ssdo_jitter(vec2 pixel) {
    return vec3(fract(52.9829189f * fract(0.06711056f * pixel.x + 0.00583715f * pixel.y)),
                fract(0.75487766f * pixel.x + 0.56984029f * pixel.y),
                fract(0.56984029f * pixel.x + 0.75487766f * pixel.y + 0.5f));
}

// Sample i of n of the unit square, moved by a pixel's jitter.
LUXEL_FN vec2 ssdo_sample(int i, int n, vec3 jitter) {
    vec2 u = hammersley(uint(i), uint(n));
    return vec2(fract(u.x + jitter.x), fract(u.y + jitter.y));
}

// Up to where a ray from a visible point, in homogeneous pixels, stays in the image and before the camera.
LUXEL_FN float length_in_view(ViewParams v, vec3 from, vec3 along, float length) {
    // Five planes: what is left of each at the start, and how fast that shrinks. A tenth of a pixel inside.
    float rim = 0.1f;
    float left[5] = {from.x - rim * from.z, (v.width - rim) * from.z - from.x, from.y - rim * from.z,
                     (v.height - rim) * from.z - from.y, from.z - v.near};
    float shrink[5] = {rim * along.z - along.x, along.x - (v.width - rim) * along.z, rim * along.z - along.y,
                       along.y - (v.height - rim) * along.z, -along.z};
    float t = length;
    for (int i = 0; i < 5; ++i)
        if (shrink[i] > 0.0f) t = min(t, max(left[i], 0.0f) / shrink[i]);
    return t;
}

// Distance of point k of n along a ray of that length: stratified, denser near the receiver, where what is
// missed would subtend the most; the last one is its end.
LUXEL_FN float ssdo_distance(int k, int n, float shift, float length) {
    float u = (float(k) + shift) / (float(n - 1) + shift);
    return length * u * u;
}

// Around +z, density 1/(2 pi).
LUXEL_FN vec3 sample_uniform_hemisphere(vec2 u) {
    float r = sqrt(max(0.0f, 1.0f - u.x * u.x));
    return vec3(r * cos(2.0f * PI * u.y), r * sin(2.0f * PI * u.y), u.x);
}

LUXEL_END
#endif
