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
    float cos_inner;  // spot
    float cos_outer;  // spot
};

struct LightSample {
    vec3 wi;          // from the surface toward the light, unit
    float distance;   // meters; a large number for directional
    vec3 irradiance;  // W/m2 on a plane facing the light at the receiver, before visibility and the cosine
};

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
    float c = -dot(light.direction, s.wi);
    if (light.type == LIGHT_SPOT) {
        float t = clamp((c - light.cos_outer) / max(light.cos_inner - light.cos_outer, 1e-4f), 0.0f, 1.0f);
        s.irradiance = s.irradiance * (t * t);
    }
    if (light.type == LIGHT_COSINE) s.irradiance = s.irradiance * max(c, 0.0f);
    return s;
}

LUXEL_END
#endif
