// SPDX-License-Identifier: MIT
// KHR_materials_clearcoat: a clear layer of index 1.5 over everything else.
#ifndef LUXEL_SHARED_CLEARCOAT_H
#define LUXEL_SHARED_CLEARCOAT_H
#include "shared/brdf.h"
LUXEL_BEGIN

struct Coat {
    Brdf lobe;    // without a diffuse part
    float passes; // share of what is below the coat, emission aside, that shows through it
};

// Toward cos_o to the coat's normal. share: clearcoat; multiple_scattering: as the lobes below have it, 0
// or 1. What shows through is what the coat does not reflect toward the viewer. For a smooth coat that is the
// extension's 1 - share F(cos_o); for a rough one the lobe's directional albedo stands in the place of F, so
// that a white coated surface is white.
LUXEL_FN Coat make_coat(float share, float roughness, float cos_o, float multiple_scattering) {
    const float f0 = 0.04f;
    Coat c;
    c.lobe.alpha = max(roughness * roughness, MIN_ALPHA);
    DirectionalAlbedo a = ggx_directional_albedo(cos_o, c.lobe.alpha);
    float gain = 1.0f + f0 * multiple_scattering * (1.0f - a.whole) / a.whole;
    c.lobe.diffuse = vec3(0.0f);
    c.lobe.f0 = vec3(share * gain * f0);
    c.lobe.f90 = vec3(share * gain);
    c.passes = 1.0f - share * gain * (f0 * (a.whole - a.grazing) + a.grazing);
    return c;
}

// A coated surface by one specular lobe, for whoever has room for one only: the coat's over dielectrics, the
// lobe below over metals, between them in proportion. It reflects of uniform light what both together do,
// except that the lobe below a coat over a dielectric moves to the diffuse lobe. below: toward cos_o, as it
// is without a coat.
LUXEL_FN Brdf coated_by_one_lobe(Brdf below, Coat coat, float share, float metallic, float cos_o) {
    float moved = share * (1.0f - metallic);
    vec3 of_below =
        reflectance_of(below.f0, below.f90.x, ggx_directional_albedo(cos_o, below.alpha)) * coat.passes;
    Brdf b;
    b.alpha = mix(below.alpha, coat.lobe.alpha, moved);
    b.diffuse = below.diffuse * coat.passes + of_below * moved;
    vec3 left = of_below * (1.0f - moved) + vec3(1.0f - coat.passes);
    vec3 f0 = mix(below.f0, vec3(0.04f), moved);
    float f90 = mix(below.f90.x, 1.0f, moved);
    vec3 before = max(reflectance_of(f0, f90, ggx_directional_albedo(cos_o, b.alpha)), vec3(1e-6f));
    vec3 scale = left / before;
    b.f0 = f0 * scale;
    b.f90 = vec3(f90 * dot(scale, vec3(0.2126f, 0.7152f, 0.0722f)));
    return b;
}

LUXEL_END
#endif
