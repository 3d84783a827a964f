// SPDX-License-Identifier: MIT
// Flux in the pixels of a light's view [Dachsbacher2005, 3].
#ifndef LUXEL_COMMON_RSM_PARAMS_H
#define LUXEL_COMMON_RSM_PARAMS_H
#include "shared/light.h"
#include "techniques/frame/view_params.h"
LUXEL_BEGIN

struct RsmParams {
    ViewParams view;
    Light light;
};

// Solid angle that a pixel of a perspective view covers, sr: its rectangle at distance 1, seen from the eye
// under the angle and from the distance of its center. Relative error of the midpoint: 1/(8 n^2) for n pixels
// a side of 90 degrees.
LUXEL_FN float pixel_solid_angle(ViewParams v, vec2 pixel) {
    float area = 4.0f * length(v.right) * length(v.up) / (v.width * v.height);
    vec3 d = pixel_direction(v, pixel);
    float r2 = dot(d, d);
    return area / (r2 * sqrt(r2));
}

// Area across the light's beam that a pixel covers at a position in it, m2.
LUXEL_FN float pixel_beam_area(ViewParams v, vec2 pixel, vec3 position) {
    if (v.parallel > 0.5f) return 4.0f * length(v.right) * length(v.up) / (v.width * v.height);
    vec3 d = position - v.position;
    return pixel_solid_angle(v, pixel) * dot(d, d);
}

// Flux that arrives through a pixel, W: intensity x solid angle, or irradiance across the beam x area across
// the beam.
LUXEL_FN vec3 incident_flux(RsmParams p, vec2 pixel, vec3 position) {
    return sample_light(p.light, position).irradiance * pixel_beam_area(p.view, pixel, position);
}

LUXEL_END
#endif
