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

LUXEL_END
#endif
