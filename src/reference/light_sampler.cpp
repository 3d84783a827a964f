// SPDX-License-Identifier: MIT
#include "reference/light_sampler.h"

#include <algorithm>
#include <cmath>

namespace luxel {

std::size_t find_in(const std::vector<float>& cumulative, float u) {
    auto found = std::upper_bound(cumulative.begin(), cumulative.end(), u * cumulative.back());
    return std::min(std::size_t(found - cumulative.begin()), cumulative.size() - 1);
}

Ray shadow_ray(const ShadingPoint& point, const LightArrival& light) {
    Ray ray{point.origin(light.wi), light.wi};
    if (!light.infinite) {
        // Punctual lights may touch the lamp that holds them; points on emitters are already moved off.
        ray.direction = light.target - ray.origin;
        ray.t_max = light.pdf > 0.0f ? 1.0f : 0.9999f;
    }
    return ray;
}

LightSampler::LightSampler(const Scene& scene)
    : scene_(&scene), environment_(scene.environment), pdf_(scene.instances.size()) {
    // Power of each, summed in double: there may be millions. Black triangles would only waste samples.
    std::vector<double> power;
    double total = 0.0;
    for (const EmissiveTriangle& t : emissive_triangles(scene)) {
        double p = double(luminance(t.emission)) * double(t.area) * (t.two_sided ? 2.0 : 1.0);
        if (!(p > 0.0)) continue;
        const Mesh& mesh = scene.meshes[std::size_t(scene.instances[std::size_t(t.instance)].mesh)];
        const Material& material = scene.materials[std::size_t(mesh.material)];
        const bool textured =
            material.emission_texture.texture >= 0 || material.alpha_mode == AlphaMode::blend;
        glm::vec3 largest = glm::max(glm::max(glm::abs(t.a), glm::abs(t.b)), glm::abs(t.c));
        emitters_.push_back(
            {t, 0.0f, clearance(std::max(std::max(largest.x, largest.y), largest.z)), textured});
        power.push_back(p);
        total += p;
    }
    double sum = 0.0;
    for (std::size_t i = 0; i < emitters_.size(); ++i) {
        const EmissiveTriangle& t = emitters_[i].triangle;
        sum += power[i];
        cumulative_.push_back(float(sum / total));
        float before = i > 0 ? cumulative_[i - 1] : 0.0f;
        emitters_[i].area_pdf = (cumulative_[i] - before) / t.area; // of the rounded table that is sampled

        std::vector<float>& of_instance = pdf_[std::size_t(t.instance)];
        if (of_instance.empty()) {
            const Instance& instance = scene.instances[std::size_t(t.instance)];
            of_instance.resize(scene.meshes[std::size_t(instance.mesh)].indices.size() / 3);
        }
        of_instance[t.triangle] = emitters_[i].area_pdf;
    }
    for (std::size_t i = 0; i < emitters_.size(); ++i)
        guide_.push_back(std::uint32_t(find_in(cumulative_, float(i) / float(emitters_.size()))));
}

std::size_t LightSampler::choose_emitter(float u) const {
    // Start where the guide says and step to the emitter whose share holds u: one or two steps on average.
    std::size_t i = guide_[std::min(std::size_t(u * float(guide_.size())), guide_.size() - 1)];
    while (i + 1 < cumulative_.size() && cumulative_[i] <= u) ++i;
    while (i > 0 && cumulative_[i - 1] > u) --i;
    const char* lines = reinterpret_cast<const char*>(&emitters_[i]);
    __builtin_prefetch(lines), __builtin_prefetch(lines + sizeof(Emitter) - 1);
    return i;
}

LightArrival LightSampler::sample_emitter(std::size_t emitter, glm::vec3 from, glm::vec2 u) const {
    const Emitter& e = emitters_[emitter];
    const EmissiveTriangle& t = e.triangle;
    LightArrival arrival{{}, {}, false, glm::vec3(0.0f), 0.0f};

    // Uniform on the triangle [Turk1990].
    float root = std::sqrt(u.x);
    glm::vec2 uv(root * (1.0f - u.y), root * u.y);
    glm::vec3 point = t.a * (1.0f - uv.x - uv.y) + t.b * uv.x + t.c * uv.y;

    glm::vec3 d = point - from;
    float r2 = glm::dot(d, d);
    float facing = -glm::dot(t.normal, d);
    if (r2 <= 0.0f || facing == 0.0f || (facing < 0.0f && !t.two_sided) || e.area_pdf <= 0.0f) return arrival;
    float r = std::sqrt(r2);
    arrival.wi = d / r;
    arrival.pdf = e.area_pdf * r2 * r / std::abs(facing);
    glm::vec3 emission =
        e.textured ? emission_at(*scene_, std::uint32_t(t.instance), t.triangle, uv) : t.emission;
    arrival.radiance = emission / arrival.pdf;

    // End the shadow ray in front of the emitter, clear of its own rounding.
    arrival.target = point + t.normal * (facing > 0.0f ? e.clear : -e.clear);
    return arrival;
}

LightArrival LightSampler::sample_environment(glm::vec2 u) const {
    EnvironmentSample s = environment_.sample(u);
    LightArrival arrival{s.direction, {}, true, glm::vec3(0.0f), s.pdf};
    if (s.pdf > 0.0f) arrival.radiance = s.radiance / s.pdf;
    return arrival;
}

LightArrival LightSampler::punctual(std::size_t light, glm::vec3 from) const {
    const shared::Light& l = scene_->lights[light];
    shared::LightSample s = shared::sample_light(l, from);
    return {s.wi, l.position, l.type == shared::LIGHT_DIRECTIONAL, s.irradiance, 0.0f};
}

bool LightSampler::choose_among(const ShadingPoint& point, std::vector<float>& cumulative) const {
    cumulative.clear();
    float sum = 0.0f;
    for (const shared::Light& light : scene_->lights) {
        shared::LightSample s = shared::sample_light(light, point.surface->position);
        sum += luminance(s.irradiance) * std::max(glm::dot(point.normal, s.wi), 0.0f);
        cumulative.push_back(sum);
    }
    return sum > 0.0f;
}

float LightSampler::emitter_pdf(const Hit& hit, const Surface& surface, glm::vec3 from, glm::vec3 wi) const {
    const std::vector<float>& of_instance = pdf_[hit.instance];
    if (of_instance.empty()) return 0.0f;
    glm::vec3 d = surface.position - from;
    float cosine = std::abs(glm::dot(surface.geometric_normal, wi));
    return cosine > 0.0f ? of_instance[hit.triangle] * glm::dot(d, d) / cosine : 0.0f;
}

} // namespace luxel
