// SPDX-License-Identifier: MIT
#include "reference/bsdf.h"

#include <cmath>

#include "shared/sampling.h"
#include "shared/thin_sheet.h"

namespace luxel {

ShadingPoint::ShadingPoint(const Surface& s, glm::vec3 direction)
    : surface(&s), wo(-glm::normalize(direction)), normal(s.front ? s.normal : -s.normal),
      geometric_normal(s.front ? s.geometric_normal : -s.geometric_normal),
      mirror(shared::is_mirror(s.metallic, s.roughness)) {
    // Chances follow what each lobe would reflect of uniform light; glass passes nearly all on.
    diffuse_chance = luminance(s.brdf.diffuse);
    specular_chance = luminance(shared::fresnel_schlick(s.brdf.f0, s.brdf.f90, glm::dot(normal, wo)));
    glass_chance = s.transmission;
    float sum = diffuse_chance + specular_chance + glass_chance;
    float scale = sum > 0.0f ? 1.0f / sum : 0.0f;
    diffuse_chance *= scale, specular_chance *= scale, glass_chance *= scale;
}

glm::vec3 ShadingPoint::origin(glm::vec3 direction) const {
    float side = glm::dot(geometric_normal, direction) >= 0.0f ? 1.0f : -1.0f;
    return surface->position + geometric_normal * (side * surface->offset);
}

Surface lambertian_part(Surface surface) {
    surface.brdf.f0 = surface.brdf.f90 = glm::vec3(0.0f);
    surface.transmission = 0.0f;
    return surface;
}

Surface specular_part(Surface surface, float specular_roughness) {
    surface.brdf.diffuse = glm::vec3(0.0f);
    const bool mirror = shared::is_mirror(surface.metallic, surface.roughness);
    if (!mirror && !has_specular_ggx(surface, specular_roughness))
        surface.brdf.f0 = surface.brdf.f90 = glm::vec3(0.0f);
    return surface;
}

BsdfValue evaluate_bsdf(const ShadingPoint& p, glm::vec3 wi) {
    BsdfValue value;
    float cos_i = glm::dot(p.normal, wi), cos_o = glm::dot(p.normal, p.wo);
    if (cos_i <= 0.0f || glm::dot(p.geometric_normal, wi) <= 0.0f) return value;
    const shared::Brdf& b = p.surface->brdf;
    value.diffuse = b.diffuse * (cos_i / shared::PI);
    value.pdf = p.diffuse_chance * (cos_i / shared::PI);
    if (p.mirror || p.specular_chance <= 0.0f) return value;

    // Where the lobe sends light below the geometric horizon, it is mirrored there: two directions lead to
    // wi.
    for (const glm::vec3& w : {wi, shared::mirrored_at_horizon(wi, p.geometric_normal)}) {
        const float cosine = glm::dot(p.normal, w);
        if (cosine <= 0.0f) continue;
        const glm::vec3 h = glm::normalize(w + p.wo);
        const float d = shared::ggx_d(p.normal, h, b.alpha);
        const glm::vec3 fresnel = shared::fresnel_schlick(b.f0, b.f90, glm::dot(p.wo, h));
        value.specular += fresnel * (d * shared::ggx_v(cosine, cos_o, b.alpha) * cosine);
        value.pdf += p.specular_chance * shared::ggx_reflection_pdf(d, cos_o, b.alpha);
    }
    return value;
}

namespace {

// A smooth lobe was chosen: draw from it, weigh with the density of both.
BsdfSample sample_smooth(const ShadingPoint& p, bool specular, glm::vec2 u) {
    glm::mat3 frame = shared::frame_around(p.normal);
    BsdfSample sample;
    if (specular) {
        glm::vec3 h = frame * shared::sample_visible_normal(p.wo * frame, p.surface->brdf.alpha, u);
        sample.wi = glm::normalize(glm::reflect(-p.wo, h));
        if (glm::dot(sample.wi, p.normal) <= 0.0f) return sample;
        sample.wi = shared::above_horizon(sample.wi, p.geometric_normal);
    } else {
        sample.wi = frame * shared::sample_cosine_hemisphere(u);
    }
    BsdfValue value = evaluate_bsdf(p, sample.wi);
    if (value.pdf <= 0.0f) return sample;
    sample.pdf = value.pdf;
    sample.weight = value.sum() / value.pdf;
    sample.diffuse = value.diffuse / value.pdf;
    return sample;
}

BsdfSample sample_mirror(const ShadingPoint& p) {
    BsdfSample sample;
    sample.ideal = true;
    sample.wi = shared::above_horizon(glm::reflect(-p.wo, p.normal), p.geometric_normal);
    const shared::Brdf& b = p.surface->brdf;
    sample.weight = shared::fresnel_schlick(b.f0, b.f90, glm::dot(p.normal, p.wo)) / p.specular_chance;
    return sample;
}

// Reflection and refraction by exact Fresnel; a thin sheet lets light pass unbent. Radiance that enters a
// denser medium is compressed into a smaller cone: the squared ratio of indices [Walter2007, section 5.2].
BsdfSample sample_glass(const ShadingPoint& p, float u) {
    const Surface& s = *p.surface;
    bool thin = s.material->thin;
    float eta = thin || s.front ? s.material->ior : 1.0f / s.material->ior; // behind over in front
    float cos_o = glm::dot(p.normal, p.wo);
    const glm::vec3 reflected = shared::interface_reflectance(cos_o, eta, s.specular * s.specular_color);
    float chance = glm::clamp(luminance(reflected), 0.0f, 1.0f);
    float share = s.transmission / p.glass_chance;
    BsdfSample sample;
    sample.ideal = true;
    if (u < chance) {
        sample.wi = shared::above_horizon(glm::reflect(-p.wo, p.normal), p.geometric_normal);
        sample.weight = reflected * (share / chance);
        return sample;
    }
    sample.wi = thin ? -p.wo : glm::refract(-p.wo, p.normal, 1.0f / eta);
    sample.wi = shared::above_horizon(sample.wi, -p.geometric_normal);
    float compression = thin ? 1.0f : 1.0f / (eta * eta);
    sample.weight = s.base_color * (glm::vec3(1.0f) - reflected) * (compression * share / (1.0f - chance));
    return sample;
}

BsdfSample sample_radiance(const ShadingPoint& p, Random& random) {
    float u = random.next();
    glm::vec2 v = random.next2();
    if (u < p.diffuse_chance) return sample_smooth(p, false, v);
    if (u < p.diffuse_chance + p.specular_chance)
        return p.mirror ? sample_mirror(p) : sample_smooth(p, true, v);
    return p.glass_chance > 0.0f ? sample_glass(p, v.x) : BsdfSample{};
}

// What turns the weight of radiance from wi toward wo into that of flux from wo toward wi.
float flux_over_radiance(const ShadingPoint& p, glm::vec3 wi) {
    const float shading_in = glm::dot(p.normal, p.wo), shading_out = glm::dot(p.normal, wi),
                geometric_in = glm::dot(p.geometric_normal, p.wo),
                geometric_out = glm::dot(p.geometric_normal, wi);
    if (geometric_in == 0.0f || shading_out == 0.0f) return 0.0f;
    const float factor = std::abs(shading_in * geometric_out / (shading_out * geometric_in));
    if (geometric_out > 0.0f || p.surface->material->thin) return factor;
    const float eta = p.surface->front ? p.surface->material->ior : 1.0f / p.surface->material->ior;
    return factor * eta * eta;
}

} // namespace

BsdfSample sample_bsdf(const ShadingPoint& p, Random& random, Transport transport) {
    BsdfSample sample = sample_radiance(p, random);
    if (transport == Transport::flux && sample.weight != glm::vec3(0.0f)) {
        const float factor = flux_over_radiance(p, sample.wi);
        sample.weight *= factor, sample.diffuse *= factor;
    }
    return sample;
}

} // namespace luxel
