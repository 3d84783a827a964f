// SPDX-License-Identifier: MIT
#include "reference/light_sampler.h"

#include <algorithm>
#include <cmath>

#include "reference/spherical_triangle.h"

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

namespace {

// Where triangles take up more of the sphere than this, points are drawn by solid angle: uniform points of a
// large near triangle differ by far in what they send, while small ones are not worth the trigonometry.
constexpr float least_solid_angle = 0.01f;

EmitterBounds bounds_of(const EmissiveTriangle& t) {
    EmitterBounds b{{}, t.normal, 1.0f, luminance(t.emission) * t.area, t.two_sided};
    b.box.add(t.a), b.box.add(t.b), b.box.add(t.c);
    return b;
}

// 1/m2 to 1/sr.
float by_angle(float area_pdf, glm::vec3 normal, glm::vec3 d) {
    const float r2 = glm::dot(d, d), facing = std::abs(glm::dot(normal, d));
    return facing > 0.0f ? area_pdf * r2 * std::sqrt(r2) / facing : 0.0f;
}

} // namespace

LightSampler::LightSampler(const Scene& scene)
    : scene_(&scene), environment_(scene.environment), emitter_of_(scene.instances.size()) {
    std::vector<EmitterBounds> bounds;
    for (const EmissiveTriangle& t : emissive_triangles(scene)) {
        const EmitterBounds b = bounds_of(t);
        if (!(b.power > 0.0f)) continue;
        const Mesh& mesh = scene.meshes[std::size_t(scene.instances[std::size_t(t.instance)].mesh)];
        const Material& material = scene.materials[std::size_t(mesh.material)];
        const glm::vec3 largest = glm::max(glm::max(glm::abs(t.a), glm::abs(t.b)), glm::abs(t.c));
        Emitter e{t, clearance(std::max(std::max(largest.x, largest.y), largest.z)), -1,
                  material.emission_texture.texture >= 0 || material.alpha_mode != AlphaMode::opaque};
        if (material.emission_texture.texture >= 0) {
            EmissionMap map(scene, std::uint32_t(t.instance), t.triangle);
            if (map.varies()) e.map = int(maps_.size()), maps_.push_back(std::move(map));
        }
        emitters_.push_back(e), bounds.push_back(b);
        std::vector<std::uint32_t>& of_instance = emitter_of_[std::size_t(t.instance)];
        if (of_instance.empty()) of_instance.resize(mesh.indices.size() / 3);
        of_instance[t.triangle] = std::uint32_t(emitters_.size());
    }
    tree_ = LightTree(bounds);
}

LightSampler::Place LightSampler::draw(const Emitter& e, glm::vec3 from, glm::vec2 v) const {
    const EmissiveTriangle& t = e.triangle;
    if (e.map >= 0) {
        const EmissionMap::Drawn drawn = maps_[std::size_t(e.map)].draw(v);
        const glm::vec3 d = t.a + (t.b - t.a) * drawn.uv.x + (t.c - t.a) * drawn.uv.y - from;
        return {drawn.uv, by_angle(drawn.density / t.area, t.normal, d)};
    }
    const SphericalTriangle seen(from, t.a, t.b, t.c);
    if (seen.solid_angle > least_solid_angle) {
        // Where the direction meets the triangle's plane.
        const glm::vec3 w = seen.sample(v), e1 = t.b - t.a, e2 = t.c - t.a, across = glm::cross(w, e2);
        const float determinant = glm::dot(e1, across);
        if (determinant == 0.0f) return {};
        const glm::vec3 s = from - t.a;
        glm::vec2 uv = glm::vec2(glm::dot(s, across), glm::dot(w, glm::cross(s, e1))) / determinant;
        uv = glm::clamp(uv, 0.0f, 1.0f);
        return {uv / std::max(uv.x + uv.y, 1.0f), 1.0f / seen.solid_angle};
    }
    // Uniform on the triangle [Turk1990].
    const float root = std::sqrt(v.x);
    const glm::vec2 uv(root * (1.0f - v.y), root * v.y);
    const glm::vec3 d = t.a + (t.b - t.a) * uv.x + (t.c - t.a) * uv.y - from;
    return {uv, by_angle(1.0f / t.area, t.normal, d)};
}

float LightSampler::pdf(const Emitter& e, glm::vec3 from, glm::vec3 point, glm::vec2 uv) const {
    const EmissiveTriangle& t = e.triangle;
    if (e.map >= 0) return by_angle(maps_[std::size_t(e.map)].density(uv) / t.area, t.normal, point - from);
    const float solid_angle = SphericalTriangle(from, t.a, t.b, t.c).solid_angle;
    return solid_angle > least_solid_angle ? 1.0f / solid_angle
                                           : by_angle(1.0f / t.area, t.normal, point - from);
}

LightArrival LightSampler::sample_emitter(glm::vec3 from, glm::vec3 normal, float u, glm::vec2 v) const {
    LightArrival arrival{{}, {}, false, glm::vec3(0.0f), 0.0f};
    const LightTree::Choice choice = tree_.choose(from, normal, u);
    if (choice.chance <= 0.0f) return arrival;
    const Emitter& e = emitters_[choice.emitter];
    const EmissiveTriangle& t = e.triangle;
    const Place place = draw(e, from, v);
    const glm::vec3 point = t.a + (t.b - t.a) * place.uv.x + (t.c - t.a) * place.uv.y, d = point - from;
    const float r2 = glm::dot(d, d), facing = -glm::dot(t.normal, d);
    if (!(r2 > 0.0f) || facing == 0.0f || (facing < 0.0f && !t.two_sided) || !(place.pdf > 0.0f))
        return arrival;
    arrival.wi = d / std::sqrt(r2);
    arrival.pdf = place.pdf * choice.chance;
    const std::uint32_t instance = std::uint32_t(t.instance);
    if (e.varies && is_transparent(*scene_, instance, t.triangle, place.uv)) return arrival;
    const glm::vec3 emission = e.varies ? emission_at(*scene_, instance, t.triangle, place.uv) : t.emission;
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
    const bool both_sides = point.receiving_normal() == glm::vec3(0.0f);
    for (const shared::Light& light : scene_->lights) {
        shared::LightSample s = shared::sample_light(light, point.surface->position);
        const float cosine = glm::dot(point.normal, s.wi);
        sum += luminance(s.irradiance) * (both_sides ? std::abs(cosine) : std::max(cosine, 0.0f));
        cumulative.push_back(sum);
    }
    return sum > 0.0f;
}

float LightSampler::emitter_pdf(const Hit& hit, const Surface& surface, glm::vec3 from, glm::vec3 normal,
                                glm::vec3 wi) const {
    const std::vector<std::uint32_t>& of_instance = emitter_of_[hit.instance];
    if (of_instance.empty() || of_instance[hit.triangle] == 0) return 0.0f;
    if (glm::dot(surface.geometric_normal, wi) == 0.0f) return 0.0f;
    const std::size_t emitter = of_instance[hit.triangle] - 1;
    const float chance = tree_.chance(emitter, from, normal);
    return chance > 0.0f ? chance * pdf(emitters_[emitter], from, surface.position, {hit.u, hit.v}) : 0.0f;
}

} // namespace luxel
