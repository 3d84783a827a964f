// SPDX-License-Identifier: MIT
// Thin transparent sheets (glass without a volume): light passes unbent, tinted by the base color and
// weakened by what the front reflects. The interface at the back is not counted, as glTF's
// KHR_materials_transmission has it.
#ifndef LUXEL_SHARED_THIN_SHEET_H
#define LUXEL_SHARED_THIN_SHEET_H
#include "shared/brdf.h"
LUXEL_BEGIN

// What a smooth interface reflects by channel. scale: specular x specular_color of KHR_materials_specular,
// which does not lessen total reflection. eta: index behind over index in front.
LUXEL_FN vec3 interface_reflectance(float cos_i, float eta, vec3 scale) {
    float fresnel = fresnel_dielectric(cos_i, eta);
    return fresnel < 1.0f ? min(scale * fresnel, vec3(1.0f)) : vec3(1.0f);
}

// Share of the light that goes straight through; cos_i: to the normal, either side.
LUXEL_FN vec3 thin_transmittance(float cos_i, float ior, vec3 scale, vec3 tint) {
    return tint * (vec3(1.0f) - interface_reflectance(abs(cos_i), ior, scale));
}
LUXEL_FN vec3 thin_transmittance(float cos_i, float ior, vec3 tint) {
    return thin_transmittance(cos_i, ior, vec3(1.0f), tint);
}

LUXEL_END
#endif
