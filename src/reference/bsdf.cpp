// SPDX-License-Identifier: MIT
#include "reference/bsdf.h"

#include <cmath>

#include "reference/bsdf_glass.h"
#include "shared/sampling.h"

namespace luxel {

ShadingPoint::ShadingPoint(const Surface& s, glm::vec3 direction)
    : surface(&s), wo(-glm::normalize(direction)), normal(s.front ? s.normal : -s.normal),
      geometric_normal(s.front ? s.geometric_normal : -s.geometric_normal),
      coat_normal(s.front ? s.coat_normal : -s.coat_normal),
      mirror(shared::is_mirror(s.metallic, s.roughness)), rough_glass(is_rough_glass(s)) {
    // Chances follow what each lobe would reflect of uniform light; glass passes nearly all on.
    const auto reflected = [&](const shared::Brdf& b, const glm::vec3& n) {
        return luminance(shared::fresnel_schlick(b.f0, b.f90, glm::dot(n, wo)));
    };
    diffuse_chance = luminance(s.brdf.diffuse);
    specular_chance = reflected(s.brdf, normal);
    glass_chance = s.transmission;
    coat_chance = s.has_coat() ? reflected(s.coat, coat_normal) : 0.0f;
    float sum = diffuse_chance + specular_chance + glass_chance + coat_chance;
    float scale = sum > 0.0f ? 1.0f / sum : 0.0f;
    diffuse_chance *= scale, specular_chance *= scale, glass_chance *= scale, coat_chance *= scale;
}

glm::vec3 ShadingPoint::origin(glm::vec3 direction) const {
    float side = glm::dot(geometric_normal, direction) >= 0.0f ? 1.0f : -1.0f;
    return surface->position + geometric_normal * (side * surface->offset);
}

Surface lambertian_part(Surface surface) {
    surface.brdf.f0 = surface.brdf.f90 = surface.coat.f0 = surface.coat.f90 = glm::vec3(0.0f);
    surface.transmission = 0.0f;
    return surface;
}

Surface specular_part(Surface surface, float specular_roughness) {
    surface.brdf.diffuse = glm::vec3(0.0f);
    const bool mirror = shared::is_mirror(surface.metallic, surface.roughness);
    const bool rough = !has_specular_ggx(surface, specular_roughness);
    if (!mirror && rough) surface.brdf.f0 = surface.brdf.f90 = glm::vec3(0.0f);
    if (rough && is_rough_glass(surface)) surface.transmission = 0.0f;
    // Which kind of lobe a path took is told by the roughness below the coat alone.
    if (rough || surface.coat.alpha > specular_roughness * specular_roughness)
        surface.coat.f0 = surface.coat.f90 = glm::vec3(0.0f);
    return surface;
}

namespace {

// Adds a GGX lobe that is chosen with that chance. Where it sends light below the geometric horizon, it is
// mirrored there: two directions lead to wi.
void add_lobe(BsdfValue& value, const ShadingPoint& p, const shared::Brdf& b, const glm::vec3& normal,
              float chance, const glm::vec3& wi) {
    const float cos_o = glm::dot(normal, p.wo);
    for (const glm::vec3& w : {wi, shared::mirrored_at_horizon(wi, p.geometric_normal)}) {
        const float cosine = glm::dot(normal, w);
        if (cosine <= 0.0f) continue;
        const glm::vec3 h = glm::normalize(w + p.wo);
        const float d = shared::ggx_d(normal, h, b.alpha);
        const glm::vec3 fresnel = shared::fresnel_schlick(b.f0, b.f90, glm::dot(p.wo, h));
        value.specular += fresnel * (d * shared::ggx_v(cosine, cos_o, b.alpha) * cosine);
        value.pdf += chance * shared::ggx_reflection_pdf(d, cos_o, b.alpha);
    }
}

} // namespace

BsdfValue evaluate_bsdf(const ShadingPoint& p, glm::vec3 wi) {
    BsdfValue value;
    if (p.rough_glass && p.glass_chance > 0.0f) {
        const GlassValue glass = evaluate_rough_glass(p, wi);
        value.specular = glass.value, value.pdf = glass.pdf;
    }
    if (glm::dot(p.geometric_normal, wi) <= 0.0f) return value;
    if (p.coat_chance > 0.0f) add_lobe(value, p, p.surface->coat, p.coat_normal, p.coat_chance, wi);
    const float cos_i = glm::dot(p.normal, wi);
    if (cos_i <= 0.0f) return value;
    value.diffuse = p.surface->brdf.diffuse * (cos_i / shared::PI);
    value.pdf += p.diffuse_chance * (cos_i / shared::PI);
    if (!p.mirror && p.specular_chance > 0.0f)
        add_lobe(value, p, p.surface->brdf, p.normal, p.specular_chance, wi);
    return value;
}

namespace {

// A smooth lobe has drawn that direction: weigh it with the density of all of them.
BsdfSample weighed(const ShadingPoint& p, glm::vec3 wi) {
    BsdfSample sample;
    sample.wi = wi;
    if (wi == glm::vec3(0.0f)) return sample;
    const BsdfValue value = evaluate_bsdf(p, wi);
    if (value.pdf <= 0.0f) return sample;
    sample.pdf = value.pdf;
    sample.weight = value.sum() / value.pdf;
    sample.diffuse = value.diffuse / value.pdf;
    return sample;
}

glm::vec3 sample_diffuse(const ShadingPoint& p, glm::vec2 u) {
    return shared::frame_around(p.normal) * shared::sample_cosine_hemisphere(u);
}

// Zero: the facet sends light to another one.
glm::vec3 sample_lobe(const ShadingPoint& p, const glm::vec3& normal, float alpha, glm::vec2 u) {
    const glm::mat3 frame = shared::frame_around(normal);
    const glm::vec3 h = frame * shared::sample_visible_normal(p.wo * frame, alpha, u);
    const glm::vec3 wi = glm::normalize(glm::reflect(-p.wo, h));
    return glm::dot(wi, normal) > 0.0f ? shared::above_horizon(wi, p.geometric_normal) : glm::vec3(0.0f);
}

BsdfSample sample_mirror(const ShadingPoint& p) {
    BsdfSample sample;
    sample.ideal = true;
    sample.wi = shared::above_horizon(glm::reflect(-p.wo, p.normal), p.geometric_normal);
    const shared::Brdf& b = p.surface->brdf;
    sample.weight = shared::fresnel_schlick(b.f0, b.f90, glm::dot(p.normal, p.wo)) / p.specular_chance;
    return sample;
}

BsdfSample sample_radiance(const ShadingPoint& p, Random& random) {
    float u = random.next();
    glm::vec2 v = random.next2();
    if (u < p.diffuse_chance) return weighed(p, sample_diffuse(p, v));
    u -= p.diffuse_chance;
    const shared::Brdf& below = p.surface->brdf;
    if (u < p.specular_chance)
        return p.mirror ? sample_mirror(p) : weighed(p, sample_lobe(p, p.normal, below.alpha, v));
    u -= p.specular_chance;
    if (u < p.coat_chance) return weighed(p, sample_lobe(p, p.coat_normal, p.surface->coat.alpha, v));
    if (p.glass_chance <= 0.0f) return {};
    if (!p.rough_glass) return sample_smooth_glass(p, v.x);
    return weighed(p, sample_rough_glass(p, v, (u - p.coat_chance) / p.glass_chance));
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
