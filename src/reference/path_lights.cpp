// SPDX-License-Identifier: MIT
// Light at a vertex: samples of the lights, and the weight of emission that a path meets by itself.
#include <cmath>

#include "reference/path_tracer.h"

namespace luxel {
namespace {

// [Veach1997, section 9.2.4] with exponent 2.
float power_heuristic(float pdf, float other) {
    float a = pdf * pdf, b = other * other;
    if (!std::isfinite(a)) return 1.0f; // a far sharper density than the other can be
    return a > 0.0f ? a / (a + b) : 0.0f;
}

} // namespace

glm::vec3 PathTracer::transmitted(const ShadingPoint& point, const LightArrival& light) const {
    const Ray ray = shadow_ray(point, light);
    if (options_.log) options_.log->entries.push_back({ray, true});
    return rays_->transmitted(ray);
}

void PathTracer::add_sample(const ShadingPoint& point, const LightArrival& light,
                            LightSamples& samples) const {
    if (light.radiance == glm::vec3(0.0f)) return;
    BsdfValue value = evaluate_bsdf(point, light.wi);
    if (value.sum() == glm::vec3(0.0f)) return;
    const bool weighted = light.pdf > 0.0f && options_.strategy == Strategy::mis;
    const glm::vec3 radiance = light.radiance * (weighted ? power_heuristic(light.pdf, value.pdf) : 1.0f);
    value.diffuse *= radiance, value.specular *= radiance;
    samples.samples[samples.count++] = {light, value};
}

// A few lights are all summed. Of many, some are drawn in proportion to what they would send.
void PathTracer::sample_punctual(const ShadingPoint& point, int draws, Random& random,
                                 LightSamples& samples) const {
    const std::size_t count = lights_.punctual_count();
    if (count <= all_lights_limit) {
        for (std::size_t i = 0; i < count; ++i)
            add_sample(point, lights_.punctual(i, point.surface->position), samples);
        return;
    }
    thread_local std::vector<float> cumulative;
    float u = random.next();
    if (!lights_.choose_among(point, cumulative)) return;
    for (int i = 0; i < draws; ++i) {
        std::size_t chosen = find_in(cumulative, (float(i) + u) / float(draws));
        float before = chosen > 0 ? cumulative[chosen - 1] : 0.0f;
        float chance = (cumulative[chosen] - before) / cumulative.back();
        if (chance <= 0.0f) continue;
        LightArrival light = lights_.punctual(chosen, point.surface->position);
        light.radiance /= chance * float(draws);
        add_sample(point, light, samples);
    }
}

void PathTracer::sample_lights(const ShadingPoint& point, int punctual_draws, Random& random,
                               LightSamples& samples) const {
    if (!point.has_smooth_lobes()) return;
    if (punctual_draws > 0) sample_punctual(point, punctual_draws, random, samples);
    if (options_.strategy == Strategy::bsdf_only) return;
    if (lights_.has_emitters()) {
        const float u = random.next();
        add_sample(
            point,
            lights_.sample_emitter(point.surface->position, point.receiving_normal(), u, random.next2()),
            samples);
    }
    if (lights_.has_environment()) add_sample(point, lights_.sample_environment(random.next2()), samples);
}

BsdfValue PathTracer::visible_light(const ShadingPoint& point, const LightSamples& samples) const {
    BsdfValue sum;
    for (std::size_t i = 0; i < samples.count; ++i) {
        const LightSamples::Sample& s = samples.samples[i];
        const glm::vec3 share = transmitted(point, s.light);
        sum.diffuse += share * s.reflected.diffuse;
        sum.specular += share * s.reflected.specular;
    }
    return sum;
}

// pdf 0: the ray came from the camera or an ideal lobe, and no light sample could have taken its place.
glm::vec3 PathTracer::environment_met(glm::vec3 wi, float bsdf_pdf) const {
    if (scene_->environment.empty()) return glm::vec3(0.0f);
    glm::vec3 radiance = evaluate(scene_->environment, glm::normalize(wi));
    if (bsdf_pdf <= 0.0f || options_.strategy == Strategy::bsdf_only) return radiance;
    if (options_.strategy == Strategy::lights_only) return glm::vec3(0.0f);
    return radiance * power_heuristic(bsdf_pdf, lights_.environment_pdf(wi));
}

glm::vec3 PathTracer::emission_met(const Hit& hit, const Surface& surface, const Sender& from, glm::vec3 wi,
                                   float bsdf_pdf) const {
    if (surface.emission == glm::vec3(0.0f)) return glm::vec3(0.0f);
    if (!surface.front && !surface.material->double_sided) return glm::vec3(0.0f);
    if (bsdf_pdf <= 0.0f || options_.strategy == Strategy::bsdf_only) return surface.emission;
    float light_pdf = lights_.emitter_pdf(hit, surface, from.position, from.normal, wi);
    if (options_.strategy == Strategy::lights_only)
        return light_pdf > 0.0f ? glm::vec3(0.0f) : surface.emission;
    return surface.emission * power_heuristic(bsdf_pdf, light_pdf);
}

} // namespace luxel
