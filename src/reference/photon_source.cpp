// SPDX-License-Identifier: MIT
#include "reference/photon_source.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"
#include "scene/thin_sheets.h"
#include "shared/sampling.h"
#include "shared/thin_sheet.h"

namespace luxel {
namespace {

constexpr float by_area = 0.1f;             // share of the photons that the first look does not place
constexpr std::size_t most_rays = 1u << 20; // of the first look
constexpr int lights_for_area = 32;         // that stand for emitters and for the environment in it
constexpr std::size_t tests_a_light = 4;    // of a triangle, where there are few triangles

// Textures only lower factors: what the smoothest texel and the most metallic one make of the material.
bool may_be_specular(const Scene& scene, const Material& m, float specular_roughness) {
    float roughness = m.roughness, metallic = m.metallic;
    if (const int texture = m.metallic_roughness_texture.texture; texture >= 0) {
        const Pixels& pixels = scene.textures[std::size_t(texture)].pixels;
        float smoothest = 1.0f, metal = 0.0f;
        for (std::size_t i = 0, end = std::size_t(pixels.width) * std::size_t(pixels.height) * 4; i < end;
             i += 4)
            smoothest = std::min(smoothest, pixels.value(i + 1)),
            metal = std::max(metal, pixels.value(i + 2));
        roughness *= smoothest, metallic *= metal;
    }
    return m.transmission > 0.0f || shared::is_mirror(metallic, roughness) || roughness <= specular_roughness;
}

// Uniform on the triangle [Turk1990].
glm::vec2 on_triangle(glm::vec2 u) {
    const float root = std::sqrt(u.x);
    return {root * (1.0f - u.y), root * u.y};
}

} // namespace

PhotonSource::PhotonSource(const RayCaster& rays, float specular_roughness, bool only_punctual)
    : rays_(&rays), scene_(&rays.scene()), specular_roughness_(specular_roughness),
      only_punctual_(only_punctual), lights_(rays.scene()) {
    find_targets();
    const auto kinds = kinds_there();
    if (std::none_of(kinds.begin(), kinds.end(), [](bool there) { return there; })) targets_.clear();
    if (!targets_.empty()) look_at_targets();
}

std::array<bool, PhotonSource::kind_count> PhotonSource::kinds_there() const {
    return {lights_.punctual_count() > 0, !only_punctual_ && lights_.has_emitters(),
            !only_punctual_ && lights_.has_environment()};
}

void PhotonSource::find_targets() {
    std::vector<bool> specular;
    for (const Material& m : scene_->materials)
        specular.push_back(may_be_specular(*scene_, m, specular_roughness_));
    for (std::uint32_t i = 0; i < scene_->instances.size(); ++i) {
        const Instance& instance = scene_->instances[i];
        const Mesh& mesh = scene_->meshes[std::size_t(instance.mesh)];
        if (!specular[std::size_t(mesh.material)]) continue;
        const float winding = handedness(instance.transform);
        for (std::uint32_t t = 0; t < mesh.indices.size() / 3; ++t) {
            const ShadingTriangle s = shading_triangle(*scene_, i, t);
            const glm::vec3 &a = s.positions[0], &b = s.positions[1], &c = s.positions[2];
            const glm::vec3 cross = glm::cross(b - a, c - a) * winding;
            const float length = glm::length(cross);
            if (length > 0.0f) targets_.push_back({a, b, c, cross / length, i, t, length * 0.5f, 0.0f});
        }
    }
}

namespace {

// A light of the first look, and the kind that it stands for.
struct LookLight {
    shared::Light light;
    int kind;
};

std::vector<LookLight> lights_to_look_from(const Scene& scene, bool only_punctual) {
    std::vector<LookLight> lights;
    const auto add = [&](const std::vector<shared::Light>& some, int kind) {
        for (const shared::Light& light : some) lights.push_back({light, kind});
    };
    add(scene.lights, 0);
    if (only_punctual) return lights;
    add(emitter_sample_lights(scene, lights_for_area, 1), 1);
    if (!scene.environment.empty()) add(environment_sample_lights(scene.environment, lights_for_area, 1), 2);
    return lights;
}

} // namespace

// Light that the triangle would send on if all of it were as this point, before chances.
double PhotonSource::sent_on(const Target& target, glm::vec2 uv, const shared::Light& from) const {
    const shared::LightSample light = shared::sample_light(from, target.at(uv));
    if (light.irradiance == glm::vec3(0.0f)) return 0.0;
    const Surface surface =
        specular_part(surface_at(*scene_, target.hit(uv), -light.wi), specular_roughness_);
    const ShadingPoint point(surface, -light.wi);
    const float cosine = std::abs(glm::dot(surface.geometric_normal, light.wi));
    // Of a clear sheet it is what its front mirrors: the rest goes straight on or is absorbed.
    const float cos_o = glm::dot(point.normal, point.wo);
    float share = luminance(shared::fresnel_schlick(surface.brdf.f0, surface.brdf.f90, cos_o));
    share += is_clear_sheet(surface)
                 ? surface.transmission *
                       luminance(shared::interface_reflectance(cos_o, surface.material->ior,
                                                               surface.specular * surface.specular_color))
                 : surface.transmission;
    const float level = luminance(light.irradiance) * cosine * share;
    const bool far = from.type == shared::LIGHT_DIRECTIONAL;
    if (level <= 0.0f) return 0.0;
    const glm::vec3 arrives = rays_->transmitted(shadow_ray(point, {light.wi, from.position, far, {}, 0.0f}));
    return double(level * luminance(arrives) * target.area);
}

void PhotonSource::look_at_targets() {
    const std::vector<LookLight> lights = lights_to_look_from(*scene_, only_punctual_);
    std::vector<ByKind> sent(targets_.size());
    if (!lights.empty()) {
        // Points of each triangle, each asked for one of the lights.
        const std::size_t tests =
            std::clamp(most_rays / targets_.size(), std::size_t(1), lights.size() * tests_a_light);
        parallel_for(targets_.size(), 64, [&](std::size_t i) {
            for (std::size_t k = 0; k < tests; ++k) {
                const shared::uint key = shared::hash2(shared::uint(i), shared::uint(k));
                const glm::vec2 uv =
                    on_triangle({shared::uniform_float(key), shared::uniform_float(shared::pcg(key))});
                const LookLight& from = lights[(k + shared::hash2(key, 1u)) % lights.size()];
                sent[i][std::size_t(from.kind)] +=
                    sent_on(targets_[i], uv, from.light) * double(lights.size()) / double(tests);
            }
        });
    }
    set_chances(sent);
}

// Chances of triangles and of kinds of light. What exists keeps some whatever the look has found.
void PhotonSource::set_chances(const std::vector<ByKind>& sent) {
    double total_area = 0.0, total = 0.0;
    ByKind by_kind{};
    for (std::size_t i = 0; i < targets_.size(); ++i) {
        total_area += double(targets_[i].area);
        for (std::size_t k = 0; k < kind_count; ++k) by_kind[k] += sent[i][k], total += sent[i][k];
    }
    const double placed = total > 0.0 ? 1.0 - double(by_area) : 0.0,
                 scale = total > 0.0 ? placed / total : 0.0;
    double sum = 0.0;
    for (std::size_t i = 0; i < targets_.size(); ++i) {
        const double chance = (1.0 - placed) * double(targets_[i].area) / total_area +
                              scale * (sent[i][0] + sent[i][1] + sent[i][2]);
        targets_[i].chance = float(chance);
        cumulative_.push_back(sum += chance);
    }
    const auto exists = kinds_there();
    const double kinds = double(exists[0]) + double(exists[1]) + double(exists[2]);
    for (std::size_t k = 0; k < kind_count; ++k)
        if (exists[k]) kind_chance_[k] = float((1.0 - placed) / kinds + scale * by_kind[k]);
}

// Of many punctual lights one is chosen by what it would send.
LightArrival PhotonSource::one_punctual(glm::vec3 position, glm::vec3 normal, float u) const {
    const auto level = [&](const shared::Light& light) {
        const shared::LightSample s = shared::sample_light(light, position);
        return luminance(s.irradiance) * std::abs(glm::dot(normal, s.wi));
    };
    float total = 0.0f;
    for (const shared::Light& light : scene_->lights) total += level(light);
    LightArrival none{{}, {}, false, glm::vec3(0.0f), 0.0f};
    float left = u * total;
    for (std::size_t i = 0; i < scene_->lights.size(); ++i) {
        const float share = level(scene_->lights[i]);
        left -= share;
        if (share <= 0.0f || (left >= 0.0f && i + 1 < scene_->lights.size())) continue;
        LightArrival arrival = lights_.punctual(i, position);
        arrival.radiance *= total / share;
        return arrival;
    }
    return none;
}

LightArrival PhotonSource::arrival(Kind kind, glm::vec3 position, glm::vec3 normal, Random& random) const {
    const float u = random.next();
    const glm::vec2 v = random.next2();
    switch (kind) {
    case punctual:
        return one_punctual(position, normal, u);
    case emitter:
        return lights_.sample_emitter(position, glm::vec3(0.0f), u, v);
    default:
        return lights_.sample_environment(v);
    }
}

std::optional<PhotonPath> PhotonSource::start(Random& random) const {
    const double u = double(random.next()) * cumulative_.back();
    const auto chosen = std::upper_bound(cumulative_.begin(), cumulative_.end(), u) - cumulative_.begin();
    const Target& target = targets_[std::min(std::size_t(chosen), targets_.size() - 1)];
    const glm::vec2 uv = on_triangle(random.next2());

    // A kind of light, then one of its lights.
    float w = random.next();
    std::size_t kind = 0;
    while (kind + 1 < kind_count && w >= kind_chance_[kind]) w -= kind_chance_[kind++];
    while (kind > 0 && kind_chance_[kind] <= 0.0f) --kind;
    const LightArrival light = arrival(Kind(kind), target.at(uv), target.normal, random);
    if (light.radiance == glm::vec3(0.0f) || target.chance <= 0.0f) return std::nullopt;
    if (is_transparent(*scene_, target.instance, target.triangle, uv)) return std::nullopt;

    const Surface surface = surface_at(*scene_, target.hit(uv), -light.wi);
    if (surface.coverage < 1.0f && random.next() >= surface.coverage) return std::nullopt;
    PhotonPath path;
    path.ray.direction = -light.wi;
    path.power = light.radiance * (std::abs(glm::dot(surface.geometric_normal, light.wi)) * target.area /
                                   (target.chance * kind_chance_[kind]));
    if (!light.infinite)
        path.power *= path.media.transmittance(glm::length(light.target - surface.position), &surface);
    const ShadingPoint point(surface, -light.wi);
    path.power *= rays_->transmitted(shadow_ray(point, light));
    if (path.power == glm::vec3(0.0f)) return std::nullopt;
    if (scatter_photon(path, surface, specular_roughness_, random) != PhotonTurn::turned) return std::nullopt;
    return path;
}

PhotonTurn scatter_photon(PhotonPath& path, const Surface& surface, float specular_roughness,
                          Random& random) {
    const Surface specular = specular_part(surface, specular_roughness);
    const ShadingPoint point(specular, path.ray.direction);
    const BsdfSample sample = sample_bsdf(point, random, Transport::flux);
    const float strongest = std::max(std::max(sample.weight.x, sample.weight.y), sample.weight.z);
    if (!(strongest > 0.0f)) return PhotonTurn::ended;
    const float survival = std::min(strongest, 1.0f);
    if (random.next() >= survival) return PhotonTurn::ended;
    path.power *= sample.weight / survival;
    path.media.leave(surface, sample.wi);
    path.ray = {point.origin(sample.wi), sample.wi};
    return sample.straight ? PhotonTurn::straight : PhotonTurn::turned;
}

} // namespace luxel
