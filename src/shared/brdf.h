// SPDX-License-Identifier: MIT
// The surface model: a Lambertian diffuse lobe plus one GGX specular lobe (glTF 2.0 metallic-roughness).
// The diffuse lobe's albedo does not depend on direction, so that every technique agrees on what "diffuse"
// is: glTF's (1 - F(v.h)) factor is replaced by its cosine-weighted hemispherical mean, 1 - (f0 + (f90 -
// f0)/21).
#ifndef LUXEL_SHARED_BRDF_H
#define LUXEL_SHARED_BRDF_H
#include "shared/glsl.h"
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

// The same surface, a share of it only: every lobe times `share`.
LUXEL_FN Brdf scale_brdf(Brdf b, float share) {
    b.diffuse = b.diffuse * share;
    b.f0 = b.f0 * share;
    b.f90 = b.f90 * share;
    return b;
}

// A shading normal that interpolation or a normal map turned away is bent back, so that it lies in the
// hemispheres of the geometric normal ng and of the direction to the viewer wo (both on one side: dot(ng, wo)
// >= 0).
LUXEL_CONST float LEAST_FACING_COSINE = 0.01f;
LUXEL_FN vec3 facing_normal(vec3 n, vec3 ng, vec3 wo) {
    float c = dot(n, ng);
    if (c < LEAST_FACING_COSINE) n = normalize(n + ng * (LEAST_FACING_COSINE - c));
    c = dot(n, wo);
    if (c < LEAST_FACING_COSINE) n = normalize(n + wo * (LEAST_FACING_COSINE - c));
    return n;
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

// Both lobes, 1/sr, without the cosine. Zero below the horizon.
LUXEL_FN vec3 evaluate_brdf(Brdf b, vec3 n, vec3 wo, vec3 wi) {
    if (dot(n, wi) <= 0.0f || dot(n, wo) <= 0.0f) return vec3(0.0f);
    return b.diffuse / PI + evaluate_specular(b, n, wo, wi);
}

LUXEL_END
#endif
