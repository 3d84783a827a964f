// SPDX-License-Identifier: MIT
// What specular surfaces do to photons.
#include "shared/brdf.h"
#include "shared/random.h"
#include "shared/sampling.h"

struct Scattered {
    vec3 direction;
    vec3 weight;
    bool inside; // of glass
};

// About the mirror direction by the lobe of visible micronormals; nothing below the surface [Le2014, 3.3.1.2; its Phong
// lobe is the frame's GGX here].
Scattered reflect_photon(vec3 d, vec3 n, vec3 f0, float f90, float roughness, vec2 u) {
    vec3 toward = dot(d, n) < 0.0 ? n : -n;
    if (roughness <= 0.0) {
        float cosine = abs(dot(d, n));
        return Scattered(reflect(d, toward), fresnel_schlick(f0, vec3(f90), cosine), false);
    }
    float alpha = max(roughness * roughness, MIN_ALPHA);
    mat3 frame = frame_around(toward);
    vec3 wo = -d * frame;
    vec3 h = frame * sample_visible_normal(wo, alpha, u);
    vec3 wi = reflect(d, h);
    float cos_i = dot(wi, toward), cos_o = max(wo.z, 1e-4);
    // BRDF times cosine over density: the distribution of normals is in both.
    float share = cos_i > 0.0 ? ggx_v(cos_i, cos_o, alpha) * cos_i / ggx_reflection_pdf(1.0, cos_o, alpha) : 0.0;
    return Scattered(wi, fresnel_schlick(f0, vec3(f90), dot(h, -d)) * share, false);
}

// Share that glass reflects. A thin sheet reflects at its front alone, as elsewhere.
float glass_reflectance(vec3 d, vec3 n, float ior, bool inside) {
    bool thin = ior > THIN_IOR;
    float index = thin ? ior - THIN_IOR : ior;
    return fresnel_dielectric(abs(dot(d, n)), inside ? 1.0 / index : index);
}

Scattered mirrored_by_glass(vec3 d, vec3 n, bool inside) { return Scattered(reflect(d, n), vec3(1), inside); }

Scattered refracted_by_glass(vec3 d, vec3 n, float ior, bool inside) {
    if (ior > THIN_IOR) return Scattered(d, vec3(1), inside);
    vec3 toward = dot(d, n) < 0.0 ? n : -n;
    return Scattered(refract(d, toward, inside ? ior : 1.0 / ior), vec3(1), !inside);
}

vec3 random3(uint key, uint bounce, uint seed) {
    uint bits = hash3(key, bounce, seed);
    return vec3(uniform_float(bits), uniform_float(pcg(bits)), uniform_float(pcg(pcg(bits))));
}
