// SPDX-License-Identifier: MIT
#include "reference/bsdf_glass.h"

#include <cmath>

#include "shared/sampling.h"
#include "shared/thin_sheet.h"

namespace luxel {
namespace {

// The interface as the ray meets it.
struct Interface {
    explicit Interface(const ShadingPoint& p)
        : thin(p.surface->material->thin),
          eta(thin || p.surface->front ? p.surface->material->ior : 1.0f / p.surface->material->ior),
          scale(p.surface->specular * p.surface->specular_color), alpha(p.surface->brdf.alpha) {}
    glm::vec3 reflectance(float cosine) const { return shared::interface_reflectance(cosine, eta, scale); }
    // Of choosing reflection, where the light meets a plane or a facet.
    static float chance(glm::vec3 reflected) { return glm::clamp(luminance(reflected), 0.0f, 1.0f); }
    // Radiance that enters a denser medium is compressed into a smaller cone: the squared ratio of indices
    // [Walter2007, section 5.2].
    float compression() const { return thin ? 1.0f : 1.0f / (eta * eta); }

    bool thin;
    float eta; // index behind over index in front
    glm::vec3 scale;
    float alpha;
};

// Smith's masking of one direction [Walter2007, eq. 34].
float masking(float cosine, float alpha) {
    const float a2 = alpha * alpha;
    return 2.0f * cosine / (cosine + std::sqrt(cosine * cosine * (1.0f - a2) + a2));
}

GlassValue reflected(const ShadingPoint& p, const Interface& glass, glm::vec3 wi) {
    const float cos_o = glm::dot(p.normal, p.wo), cos_i = glm::dot(p.normal, wi);
    const glm::vec3 h = glm::normalize(wi + p.wo), share = glass.reflectance(glm::dot(p.wo, h));
    const float d = shared::ggx_d(p.normal, h, glass.alpha);
    return {share * (d * shared::ggx_v(cos_i, cos_o, glass.alpha) * cos_i),
            Interface::chance(share) * shared::ggx_reflection_pdf(d, cos_o, glass.alpha)};
}

// A thin sheet spreads what it lets through as it spreads what it reflects.
GlassValue passed_by_sheet(const ShadingPoint& p, const Interface& glass, glm::vec3 wi) {
    const glm::vec3 mirrored = shared::mirrored_at_horizon(wi, p.normal);
    const float cos_o = glm::dot(p.normal, p.wo), cos_i = glm::dot(p.normal, mirrored);
    const glm::vec3 h = glm::normalize(mirrored + p.wo), share = glass.reflectance(glm::dot(p.wo, h));
    const float d = shared::ggx_d(p.normal, h, glass.alpha);
    return {(glm::vec3(1.0f) - share) * (d * shared::ggx_v(cos_i, cos_o, glass.alpha) * cos_i),
            (1.0f - Interface::chance(share)) * shared::ggx_reflection_pdf(d, cos_o, glass.alpha)};
}

// [Walter2007, eqs. 16, 17 and 21], by the density of the facets that wo sees.
GlassValue refracted(const ShadingPoint& p, const Interface& glass, glm::vec3 wi) {
    glm::vec3 h = p.wo + glass.eta * wi;
    if (!(glm::dot(h, h) > 0.0f)) return {};
    h = glm::normalize(h);
    if (glm::dot(h, p.normal) < 0.0f) h = -h;
    const float o = glm::dot(p.wo, h), i = glm::dot(wi, h), cos_o = glm::dot(p.normal, p.wo);
    if (o <= 0.0f || i >= 0.0f) return {};
    const glm::vec3 share = glass.reflectance(o);
    const float root = o + glass.eta * i;
    const float seen =
                    4.0f * o *
                    shared::ggx_reflection_pdf(shared::ggx_d(p.normal, h, glass.alpha), cos_o, glass.alpha),
                jacobian = glass.eta * glass.eta * -i / (root * root);
    return {(glm::vec3(1.0f) - share) * (seen * jacobian * masking(-glm::dot(p.normal, wi), glass.alpha)),
            (1.0f - Interface::chance(share)) * seen * jacobian};
}

} // namespace

bool is_rough_glass(const Surface& s) {
    // Without a step in the index facets bend nothing.
    return s.transmission > 0.0f && s.roughness >= shared::MIRROR_ROUGHNESS &&
           (s.material->thin || std::abs(s.material->ior - 1.0f) > 1e-3f);
}

BsdfSample sample_smooth_glass(const ShadingPoint& p, float u) {
    const Interface glass(p);
    const glm::vec3 reflected = glass.reflectance(glm::dot(p.normal, p.wo));
    const float chance = Interface::chance(reflected);
    const float share = p.surface->transmission * p.surface->glass_gain / p.glass_chance;
    BsdfSample sample;
    sample.ideal = true;
    if (u < chance) {
        sample.wi = shared::above_horizon(glm::reflect(-p.wo, p.normal), p.geometric_normal);
        sample.weight = reflected * (share / chance);
        return sample;
    }
    sample.straight = glass.thin;
    sample.wi = glass.thin ? -p.wo : glm::refract(-p.wo, p.normal, 1.0f / glass.eta);
    sample.wi = shared::above_horizon(sample.wi, -p.geometric_normal);
    sample.weight = p.surface->base_color * (glm::vec3(1.0f) - reflected) *
                    (glass.compression() * share / (1.0f - chance));
    return sample;
}

glm::vec3 sample_rough_glass(const ShadingPoint& p, glm::vec2 u, float choice) {
    const Interface glass(p);
    const glm::mat3 frame = shared::frame_around(p.normal);
    const glm::vec3 h = frame * shared::sample_visible_normal(p.wo * frame, glass.alpha, u);
    const float cosine = glm::dot(p.wo, h);
    if (cosine <= 0.0f) return glm::vec3(0.0f);
    const bool reflects = choice < Interface::chance(glass.reflectance(cosine));
    glm::vec3 wi = reflects || glass.thin ? glm::reflect(-p.wo, h) : glm::refract(-p.wo, h, 1.0f / glass.eta);
    if (glm::dot(wi, wi) < 0.5f) return glm::vec3(0.0f);
    wi = glm::normalize(wi);
    if (!reflects && glass.thin) wi = shared::mirrored_at_horizon(wi, p.normal);
    if ((glm::dot(wi, p.normal) > 0.0f) != reflects) return glm::vec3(0.0f); // it would meet another facet
    return shared::above_horizon(wi, reflects ? p.geometric_normal : -p.geometric_normal);
}

GlassValue evaluate_rough_glass(const ShadingPoint& p, glm::vec3 wi) {
    const Interface glass(p);
    const bool above = glm::dot(p.geometric_normal, wi) > 0.0f;
    const glm::vec3 tint = above ? glm::vec3(1.0f) : p.surface->base_color * glass.compression();
    GlassValue sum;
    for (const glm::vec3& w : {wi, shared::mirrored_at_horizon(wi, p.geometric_normal)}) {
        if ((glm::dot(p.normal, w) > 0.0f) != above) continue;
        const GlassValue one = above        ? reflected(p, glass, w)
                               : glass.thin ? passed_by_sheet(p, glass, w)
                                            : refracted(p, glass, w);
        sum.value += one.value * tint, sum.pdf += one.pdf;
    }
    // What facets of a thin sheet pass on to each other comes back on either side, as the BRDF has it.
    sum.value *= p.surface->transmission * p.surface->glass_gain;
    sum.pdf *= p.glass_chance;
    return sum;
}

} // namespace luxel
