// SPDX-License-Identifier: MIT
// The first vertex: what all paths through a pixel's center share of it, and components with rays of their
// own there, ambient occlusion and the bounce that nothing hides.
#include <algorithm>
#include <cmath>

#include "reference/coverage.h"
#include "reference/path_tracer.h"
#include "scene/thin_sheets.h"
#include "shared/sampling.h"

namespace luxel {

FirstVertex PathTracer::first_vertex(int x, int y) const {
    FirstVertex first;
    const Ray ray = camera_ray(glm::vec2(x, y) + glm::vec2(0.5f));
    first.found = intersect_seen(ray, first.hit);
    if (!first.found) return first;
    first.surface = surface_at(*scene_, first.hit, ray.direction);

    // No randomness is left in the light of punctual lamps: each is asked once for all paths.
    first.lit_by_all = lights_.punctual_count() <= exact_lights_limit;
    const ShadingPoint point(first.surface, ray.direction);
    if (!first.lit_by_all || !wanted_.direct || !point.has_smooth_lobes()) return first;
    for (std::size_t i = 0; i < lights_.punctual_count(); ++i) {
        LightSamples one;
        add_sample(point, lights_.punctual(i, first.surface.position), one);
        const BsdfValue lit = visible_light(point, one);
        first.lit.diffuse += lit.diffuse, first.lit.specular += lit.specular;
    }
    return first;
}

void PathTracer::add_first_vertex(const ShadingPoint& point, Random& random, PathSample& result) const {
    if (wanted_.ao) result.ao = openness(point, random);
    if (wanted_.diffuse1_unoccluded) result.diffuse1_unoccluded = unoccluded_bounce(point, random);
}

// Share of the cosine-weighted hemisphere without an occluder, occluders weighted by distance.
float PathTracer::openness(const ShadingPoint& point, Random& random) const {
    glm::vec3 local = shared::sample_cosine_hemisphere(random.next2());
    float radius = settings_.ao_radius;
    if (settings_.ao_membership == Membership::tangent) {
        // Density 2 cos^3/pi instead of cos/pi: the cosine's fourth power is uniform, not its square. The
        // radius is the chord of the tangent sphere [Umenhoffer2009, fig. 4.4].
        float cosine = std::sqrt(local.z);
        float stretch = 1.0f / std::sqrt(1.0f + local.z); // sqrt((1 - cos') / (1 - cos'^2)), cos' = local.z
        local = {local.x * stretch, local.y * stretch, cosine};
        radius *= cosine;
    }
    glm::vec3 wi = shared::frame_around(point.normal) * local;
    if (glm::dot(wi, point.geometric_normal) <= 0.0f) return 0.0f;
    const bool endless = settings_.ao_membership == Membership::exponential;
    Ray ray{point.origin(wi), wi, 0.0f, endless ? Ray{}.t_max : radius};
    Hit hit;
    float passed = 0.0f;
    if (!intersect_covered(*rays_, ray, hit, random, passed)) return 1.0f;
    const float way = passed + hit.t;
    float d = endless ? way / radius : std::min(way / radius, 1.0f);
    switch (settings_.ao_membership) {
    case Membership::sqrt:
        return std::sqrt(d);
    case Membership::cubic:
    case Membership::tangent:
        return d * d * d;
    case Membership::exponential:
        return 1.0f - std::exp(-d);
    default:
        return 0.0f;
    }
}

// One diffuse bounce through everything: each surface along the ray that turns to the receiver adds its
// light.
glm::vec3 PathTracer::unoccluded_bounce(const ShadingPoint& point, Random& random) const {
    glm::vec3 sum(0.0f), albedo = point.surface->brdf.diffuse;
    glm::vec3 wi = shared::frame_around(point.normal) * shared::sample_cosine_hemisphere(random.next2());
    if (albedo == glm::vec3(0.0f) || glm::dot(wi, point.geometric_normal) <= 0.0f) return sum;
    Ray ray{point.origin(wi), wi};
    Hit hit;
    while (intersect(ray, hit)) {
        Surface surface = surface_at(*scene_, hit, wi);
        if (surface.front || surface.material->double_sided)
            sum += surface.coverage * diffuse_reflection(surface, wi, random);
        ShadingPoint layer(surface, wi);
        ray.origin = layer.origin(wi);
    }
    return albedo * sum;
}

// Light straight from its sources that the Lambertian lobe sends back along `direction`.
glm::vec3 PathTracer::diffuse_reflection(const Surface& surface, glm::vec3 direction, Random& random) const {
    // As if it had no other lobe, so that the one direction drawn for MIS is a diffuse one.
    const Surface lambertian = lambertian_part(surface);
    ShadingPoint point(lambertian, direction);
    if (!point.has_smooth_lobes()) return glm::vec3(0.0f);
    LightSamples samples;
    sample_lights(point, later_draws, random, samples);
    glm::vec3 sum = visible_light(point, samples).diffuse;
    if (!lights_.has_emitters() && !lights_.has_environment()) return sum;

    BsdfSample sample = sample_bsdf(point, random);
    if (sample.weight == glm::vec3(0.0f)) return sum;
    return sum + sample.weight * straight_light(point, sample);
}

// Emission along a ray that a smooth lobe has sent, through thin sheets: what light samples could have found.
glm::vec3 PathTracer::straight_light(const ShadingPoint& point, const BsdfSample& sent) const {
    glm::vec3 sum(0.0f), share(1.0f);
    Ray ray{point.origin(sent.wi), sent.wi};
    Hit hit;
    while (share != glm::vec3(0.0f)) {
        if (!intersect(ray, hit)) return sum + share * environment_met(sent.wi, sent.pdf);
        const Surface met = surface_at(*scene_, hit, sent.wi);
        sum += share * met.coverage *
               emission_met(hit, met, {point.surface->position, point.receiving_normal()}, sent.wi, sent.pdf);
        share *= straight_transmittance(met, sent.wi);
        ray.origin = ShadingPoint(met, sent.wi).origin(sent.wi);
    }
    return sum;
}

} // namespace luxel
