// SPDX-License-Identifier: MIT
// The surface model: a Lambertian diffuse lobe plus one GGX specular lobe (glTF 2.0 metallic-roughness), as
// they are seen from one direction. Light that a facet passes on to another one comes back by a larger
// reflectance, and the diffuse lobe has what the specular lobe leaves of light toward the viewer: nothing is
// lost or gained from any direction. Both factors depend on the view alone, so that the diffuse lobe stays
// Lambertian: what it shows is its albedo times irradiance / pi, whatever the directions of the light.
#ifndef LUXEL_SHARED_BRDF_H
#define LUXEL_SHARED_BRDF_H
#include "shared/directional_albedo.h"
#include "shared/glsl.h"
#include "shared/horizon.h"
LUXEL_BEGIN

struct Brdf {
    vec3 diffuse; // albedo of the Lambertian lobe, [0, 1]
    vec3 f0;      // specular reflectance at normal incidence, [0, 1]
    vec3 f90;     // specular reflectance at grazing incidence, [0, 1]
    float alpha;  // GGX width = perceptual roughness squared; clamped to MIN_ALPHA by make_brdf
};

// Below this perceptual roughness a metal is an ideal mirror and a dielectric's specular lobe is clamped to
// it.
LUXEL_CONST float MIRROR_ROUGHNESS = 0.02f;
LUXEL_CONST float MIN_ALPHA = 0.0004f;

// The older model: facets scatter once, and the diffuse lobe has the hemispherical mean of what the specular
// lobe leaves, 1 - (f0 + (f90 - f0) / 21), from wherever it is seen.
// glTF 2.0 parameters to lobes. base_color linear sRGB [0, 1]; metallic, roughness [0, 1]; ior >= 1;
// specular and specular_color as KHR_materials_specular.
LUXEL_FN Brdf make_brdf(vec3 base_color, float metallic, float roughness, float ior, float specular,
                        vec3 specular_color) {
    float r = (ior - 1.0f) / (ior + 1.0f);
    vec3 dielectric_f0 = min(vec3(r * r) * specular_color, vec3(1.0f)) * specular;
    Brdf b;
    b.f0 = mix(dielectric_f0, base_color, metallic);
    b.f90 = vec3(mix(specular, 1.0f, metallic));
    vec3 mean_fresnel = dielectric_f0 + (vec3(specular) - dielectric_f0) / 21.0f;
    b.diffuse = base_color * (1.0f - metallic) * (vec3(1.0f) - mean_fresnel);
    b.alpha = max(roughness * roughness, MIN_ALPHA);
    return b;
}

LUXEL_FN vec3 fresnel_schlick(vec3 f0, vec3 f90, float cos_theta) {
    float m = clamp(1.0f - cos_theta, 0.0f, 1.0f);
    float m2 = m * m;
    return f0 + (f90 - f0) * (m2 * m2 * m);
}

// What a lobe of reflectances f0 and f90 reflects toward cos_o of light that is the same from everywhere.
LUXEL_FN vec3 reflectance_of(vec3 f0, float f90, DirectionalAlbedo a) {
    return f0 * (a.whole - a.grazing) + vec3(f90 * a.grazing);
}

// The lobes toward cos_o to the normal, with no light lost between facets: reflectances times 1 + F (1 - E) /
// E, E being the lobe's directional albedo where all facets reflect everything [Turquin2019, eq. 16]. For
// f90, one number, F is the luminance of f0.
LUXEL_FN Brdf make_brdf_toward(float cos_o, vec3 base_color, float metallic, float roughness, float ior,
                               float specular, vec3 specular_color) {
    const vec3 luminance = vec3(0.2126f, 0.7152f, 0.0722f);
    float r = (ior - 1.0f) / (ior + 1.0f);
    vec3 f0 = min(vec3(r * r) * specular_color, vec3(1.0f)) * specular;
    Brdf b;
    b.alpha = max(roughness * roughness, MIN_ALPHA);
    DirectionalAlbedo a = ggx_directional_albedo(cos_o, b.alpha);
    float again = (1.0f - a.whole) / a.whole;
    vec3 dielectric_f0 = f0 * (vec3(1.0f) + f0 * again);
    float dielectric_f90 = specular * (1.0f + dot(f0, luminance) * again);
    vec3 metal_f0 = base_color * (vec3(1.0f) + base_color * again);
    float metal_f90 = 1.0f + dot(base_color, luminance) * again;
    b.f0 = mix(dielectric_f0, metal_f0, metallic);
    b.f90 = vec3(mix(dielectric_f90, metal_f90, metallic));
    vec3 left = max(vec3(1.0f) - reflectance_of(dielectric_f0, dielectric_f90, a), vec3(0.0f));
    b.diffuse = base_color * (1.0f - metallic) * left;
    return b;
}

// Between the older model (0) and this one (1).
LUXEL_FN Brdf mix_brdf(Brdf x, Brdf y, float share) {
    x.diffuse = mix(x.diffuse, y.diffuse, share);
    x.f0 = mix(x.f0, y.f0, share);
    x.f90 = mix(x.f90, y.f90, share);
    return x;
}

// The same surface, a share of it only: every lobe times `share`.
LUXEL_FN Brdf scale_brdf(Brdf b, float share) {
    b.diffuse = b.diffuse * share;
    b.f0 = b.f0 * share;
    b.f90 = b.f90 * share;
    return b;
}

// GGX normal distribution [Walter2007, eq. 33]. The sine comes from the cross product: 1 - cos^2 would have
// no digits left where alpha is small.
LUXEL_FN float ggx_d(vec3 n, vec3 h, float alpha) {
    float a2 = alpha * alpha;
    float c = dot(n, h);
    vec3 s = cross(n, h);
    float t = c * c * a2 + dot(s, s);
    return a2 / (PI * t * t);
}

// Height-correlated Smith visibility G / (4 cos_i cos_o) [Heitz2014, eq. 99].
LUXEL_FN float ggx_v(float cos_i, float cos_o, float alpha) {
    float a2 = alpha * alpha;
    float gi = cos_o * sqrt(cos_i * cos_i * (1.0f - a2) + a2);
    float go = cos_i * sqrt(cos_o * cos_o * (1.0f - a2) + a2);
    return 0.5f / max(gi + go, 1e-12f);
}

// Density of the directions that sample_visible_normal leads to by reflection, 1/sr [Heitz2018, eq. 17]: the
// masked distribution G1(wo) D(h) (wo.h) / cos_o over the Jacobian 4 (wo.h).
LUXEL_FN float ggx_reflection_pdf(float d, float cos_o, float alpha) {
    float a2 = alpha * alpha;
    return d * 0.5f / (cos_o + sqrt(cos_o * cos_o * (1.0f - a2) + a2));
}

// Whether the specular lobe is an ideal mirror: no light sample can meet it, only a reflected ray.
LUXEL_FN bool is_mirror(float metallic, float roughness) {
    return metallic > 0.999f && roughness < MIRROR_ROUGHNESS;
}

// What specular techniques trace through: a reflector below 0, a diffuse surface at 0, a refractor above
// [Umenhoffer2009, 5.2]. The magnitude is the index of refraction, of thin refractors plus THIN_IOR. Lobes
// up to SMOOTH_ROUGHNESS count as smooth: alpha = .01 rad is less than a texel of a cube of 128.
LUXEL_CONST float SMOOTH_ROUGHNESS = 0.1f;
LUXEL_CONST float THIN_IOR = 16.0f;
LUXEL_FN float signed_ior(float metallic, float roughness, float transmission, float ior, bool thin) {
    if (roughness > SMOOTH_ROUGHNESS) return 0.0f;
    if (transmission >= 0.5f) return thin ? ior + THIN_IOR : ior;
    return metallic >= 0.5f ? -ior : 0.0f;
}

// Unpolarized reflectance of a smooth interface; eta = index behind it over the index in front; 1 beyond the
// critical angle [Walter2007, eq. 22].
LUXEL_FN float fresnel_dielectric(float cos_i, float eta) {
    float g2 = eta * eta - 1.0f + cos_i * cos_i;
    if (g2 <= 0.0f) return 1.0f;
    float g = sqrt(g2);
    float a = (g - cos_i) / (g + cos_i);
    float b = (cos_i * (g + cos_i) - 1.0f) / (cos_i * (g - cos_i) + 1.0f);
    return 0.5f * a * a * (1.0f + b * b);
}

// Specular lobe only, 1/sr, without the cosine. Zero below the horizon.
LUXEL_FN vec3 evaluate_specular(Brdf b, vec3 n, vec3 wo, vec3 wi) {
    float cos_i = dot(n, wi);
    float cos_o = dot(n, wo);
    if (cos_i <= 0.0f || cos_o <= 0.0f) return vec3(0.0f);
    vec3 h = normalize(wi + wo);
    float d = ggx_d(n, h, b.alpha);
    return fresnel_schlick(b.f0, b.f90, dot(wo, h)) * (d * ggx_v(cos_i, cos_o, b.alpha));
}

// Specular lobe times the cosine of wi, 1/sr, for wi above the geometric surface: with the light that the
// lobe would send below it.
LUXEL_FN vec3 reflect_specular(Brdf b, vec3 n, vec3 ng, vec3 wo, vec3 wi) {
    vec3 below = mirrored_at_horizon(wi, ng);
    return evaluate_specular(b, n, wo, wi) * max(dot(n, wi), 0.0f) +
           evaluate_specular(b, n, wo, below) * max(dot(n, below), 0.0f);
}

// Both lobes, 1/sr, without the cosine. Zero below the horizon.
LUXEL_FN vec3 evaluate_brdf(Brdf b, vec3 n, vec3 wo, vec3 wi) {
    if (dot(n, wi) <= 0.0f || dot(n, wo) <= 0.0f) return vec3(0.0f);
    return b.diffuse / PI + evaluate_specular(b, n, wo, wi);
}

LUXEL_END
#endif
