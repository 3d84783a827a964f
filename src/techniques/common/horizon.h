// SPDX-License-Identifier: MIT
// Slices of a receiver's hemisphere, for estimators that search horizons in the depth buffer.
#ifndef LUXEL_HORIZON_H
#define LUXEL_HORIZON_H
#include "shared/sampling.h"
#include "techniques/common/occlusion_params.h"
LUXEL_BEGIN

// A half plane pair through the receiver that contains the view direction: all of it lies on one line of the
// image. Directions in it are angles from the view direction, positive toward the tangent.
struct HorizonSlice {
    vec3 view;    // unit, to the eye
    vec3 tangent; // unit, across
    vec2 pixels;  // pixels per meter along the tangent
    float gamma;  // of the normal as projected to the slice
    float weight; // length of that projection
};

// The slice at `turn` in [0, 1) of half a revolution around the view direction (not around the image: only
// so are slices evenly distributed off the image's center). Position and normal in camera space.
LUXEL_FN HorizonSlice horizon_slice(OcclusionParams o, vec3 position, vec3 normal, float turn) {
    HorizonSlice s;
    s.view = -normalize(position);
    vec3 x = normalize(cross(vec3(0.0f, 1.0f, 0.0f), s.view)), y = cross(s.view, x);
    s.tangent = x * cos(PI * turn) + y * sin(PI * turn);
    // d/dt of the pixel of position + t tangent: pixel = (xy/z - offset) / scale.
    float z = position.z;
    s.pixels = vec2(s.tangent.x * z - position.x * s.tangent.z, s.tangent.y * z - position.y * s.tangent.z) /
               (o.ray_scale * (z * z));
    float along = dot(normal, s.view), across = dot(normal, s.tangent);
    s.gamma = clamp(atan(across, along), -0.5f * PI, 0.5f * PI);
    s.weight = sqrt(along * along + across * across);
    return s;
}

// Meters along the tangent that a sphere of radius r around the position covers in the image. Where the
// eye is in it, or nearly, that is cut off at three radii.
LUXEL_FN float horizon_reach(vec3 position, float r) {
    float s = r * r / dot(position, position);
    return r / sqrt(max(1.0f - s, 1.0f / 9.0f));
}

// Up to how many meters a line of so many pixels per meter stays in the image.
LUXEL_FN float horizon_end(OcclusionParams o, vec2 pixel, vec2 line, float reach) {
    vec2 last = vec2(o.size) - vec2(1.0f);
    float x = (line.x > 0.0f ? last.x - pixel.x : pixel.x) / max(abs(line.x), 1e-20f);
    float y = (line.y > 0.0f ? last.y - pixel.y : pixel.y) / max(abs(line.y), 1e-20f);
    return min(reach, min(x, y));
}

// Where point k of n lies, as a share of the line: evenly, the last one at the end.
LUXEL_FN float horizon_step(int k, int n, float shift) { return (float(k) + shift) / (float(n - 1) + shift); }

// How the pattern's pixel turns the slices and moves the points along them, both in [0, 1).
LUXEL_FN vec2 horizon_jitter(int pattern) {
    return vec2((float(pattern) + 0.5f) / 16.0f, (float((pattern * 7 + 3) & 15) + 0.5f) / 16.0f);
}

// What one point of the depth buffer hides: directions from the cosine `low` (of its back) to `high` (of its
// front).
struct HorizonPoint {
    float low, high;
    float distance2; // square of its distance from the receiver over that of the radius
};

// The horizon after a point: what it hides above the highest point so far comes on top of what is hidden; a
// gap below its back stays open. In order of distance.
struct Horizon {
    float hidden, top; // cosines
};
LUXEL_FN Horizon horizon_add(Horizon h, HorizonPoint p, float weight) {
    float more = max(p.high - max(p.low, h.top), 0.0f);
    h.hidden += weight * more;
    h.top = max(h.top, p.high);
    return h;
}

LUXEL_END
#endif
