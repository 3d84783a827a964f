// SPDX-License-Identifier: MIT
// Analytic lights, read by the reference and by the frame's shaders alike.
#ifndef LUXEL_SHARED_LIGHT_H
#define LUXEL_SHARED_LIGHT_H
#include "shared/glsl.h"
LUXEL_BEGIN

LUXEL_CONST uint LIGHT_POINT = 0u;       // isotropic, W/sr
LUXEL_CONST uint LIGHT_SPOT = 1u;        // glTF cone, W/sr on the axis
LUXEL_CONST uint LIGHT_DIRECTIONAL = 2u; // W/m2 on a surface that faces it
LUXEL_CONST uint LIGHT_COSINE = 3u;      // one-sided surface sample: W/sr along the normal, cosine fall-off

struct Light {
    vec3 position;    // world, meters (unused by directional)
    uint type;        // LIGHT_*
    vec3 direction;   // world, unit: the way light travels; a cosine light's normal
    float range;      // meters, glTF cut-off; 0 = none
    vec3 intensity;   // radiant, see LIGHT_*
    float inner;      // spot: versine of the half angle within which the intensity is full
    float outer;      // spot: versine of the half angle where it ends
    float extent;     // what a sample of a larger source stands for: m2 of a cosine light's surface, sr of a
                      // directional one's sky; 0 = a point of its own
};

struct LightSample {
    vec3 wi;          // from the surface toward the light, unit
    float distance;   // meters; a large number for directional
    vec3 irradiance;  // W/m2 on a plane facing the light at the receiver, before visibility and the cosine
};

// 1 - cos, which keeps all its digits where the angle is small: cosines of half a degree and of nothing differ
// by a few hundred roundings only.
LUXEL_FN float versine(float angle) {
    float s = sin(0.5f * angle);
    return 2.0f * s * s;
}
// The same of the angle between two unit vectors.
LUXEL_FN float versine(vec3 a, vec3 b) {
    vec3 d = a - b;
    return 0.5f * dot(d, d);
}
LUXEL_FN float versine_tangent(float v) { return sqrt(v * (2.0f - v)) / max(1.0f - v, 1e-4f); }
LUXEL_FN float versine_angle(float v) { return 2.0f * asin(sqrt(clamp(0.5f * v, 0.0f, 1.0f))); }

// Share of a spot light's intensity in a direction with this versine to its axis [KHR_lights_punctual]. Cones
// whose angles are equal have an edge of a hundred thousandth of their width.
LUXEL_FN float spot_falloff(float inner, float outer, float v) {
    float t = clamp((outer - v) / max(outer - inner, max(1e-5f * outer, 1e-30f)), 0.0f, 1.0f);
    return t * t;
}

// glTF KHR_lights_punctual: smooth window that reaches zero at `range`.
LUXEL_FN float range_window(float distance, float range) {
    if (range <= 0.0f) return 1.0f;
    float q = distance / range;
    return clamp(1.0f - q * q * q * q, 0.0f, 1.0f);
}

// Irradiance that the unoccluded light would send to a plane at `position` facing it.
LUXEL_FN LightSample sample_light(Light light, vec3 position) {
    LightSample s;
    if (light.type == LIGHT_DIRECTIONAL) {
        s.wi = -light.direction;
        s.distance = 1e8f;
        s.irradiance = light.intensity;
        return s;
    }
    vec3 d = light.position - position;
    float r2 = max(dot(d, d), 1e-12f);
    s.distance = sqrt(r2);
    s.wi = d / s.distance;
    s.irradiance = light.intensity * (range_window(s.distance, light.range) / r2);
    if (light.type == LIGHT_SPOT)
        s.irradiance =
            s.irradiance * spot_falloff(light.inner, light.outer, versine(-light.direction, s.wi));
    if (light.type == LIGHT_COSINE) s.irradiance = s.irradiance * max(-dot(light.direction, s.wi), 0.0f);
    return s;
}

// Solid angle that a sample of a larger source stands for at the receiver, sr; 0 for points of their own.
LUXEL_FN float sampled_solid_angle(Light light, LightSample s) {
    if (light.extent <= 0.0f || light.type == LIGHT_DIRECTIONAL) return light.extent;
    return light.extent * max(-dot(light.direction, s.wi), 0.0f) / (s.distance * s.distance);
}

// A GGX lobe's width where the light is no point but fills a solid angle. Around a half vector that is spread over a
// disc of radius q, the mean of alpha^2 / (pi (r^2 + alpha^2)^2) over the disc is 1 / (pi (q^2 + alpha^2)): the
// peak of the lobe with alpha^2 + q^2 in place of alpha^2, which is normalized as every lobe is. A half vector
// turns by d(half) = d(light) / (4 cos) in solid angle, so pi q^2 = solid_angle / (4 cos_half).
LUXEL_FN float widened_alpha(float alpha, float solid_angle, float cos_half) {
    return sqrt(min(alpha * alpha + solid_angle / (4.0f * PI * max(cos_half, 1e-4f)), 1.0f));
}

LUXEL_END
#endif
