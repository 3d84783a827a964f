// SPDX-License-Identifier: MIT
#include "reference/photon_tracer.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"
#include "reference/coverage.h"
#include "shared/brdf.h"

namespace luxel {
namespace {

constexpr double alpha = 2.0 / 3.0;
constexpr int chunk = 1024;       // photons that are traced in one go
constexpr float same_side = 0.5f; // least cosine between the normals of photon and pixel

} // namespace

// r_i^2 / r_1^2 = product of (k + alpha) / (k + 1) for k < i = gamma(i + alpha) / (gamma(i + 1) gamma(1 +
// alpha))
float relative_photon_radius(int pass) {
    const double i = pass + 1.0;
    return float(std::exp(0.5 * (std::lgamma(i + alpha) - std::lgamma(i + 1.0) - std::lgamma(1.0 + alpha))));
}

PhotonTracer::PhotonTracer(const RayCaster& rays, const ReferenceSettings& settings, PhotonWay way)
    : rays_(&rays), settings_(settings), way_(std::move(way)),
      source_(rays, way_.specular_roughness, way_.only_punctual) {}

// Its path through specular surfaces; wherever it meets another lobe, that is where a caustic is.
void PhotonTracer::trace_photon(int pass, int index, std::vector<Photon>& stored) const {
    Random random(shared::uint(pass), shared::uint(index),
                  shared::hash2(shared::uint(settings_.seed), way_.seed));
    std::optional<PhotonPath> path = source_.start(random);
    if (!path) return;
    for (int vertex = 1; vertex <= settings_.max_bounces; ++vertex) {
        Hit hit;
        if (!rays_->intersect(path->ray, hit)) return;
        const Surface surface = surface_at(rays_->scene(), hit, path->ray.direction);
        path->power *= path->media.transmittance(hit.t * glm::length(path->ray.direction), &surface);
        if (surface.coverage < 1.0f && random.next() >= surface.coverage) {
            go_behind(path->ray, hit, surface);
            continue;
        }
        if (way_.is_kept(surface)) {
            // Power over area is irradiance of the geometric surface; what is reflected goes by the shading
            // normal.
            const ShadingPoint point(surface, path->ray.direction);
            const float geometric = glm::dot(point.geometric_normal, point.wo);
            const float scale = glm::dot(point.normal, point.wo) / (geometric * float(settings_.photons));
            if (geometric > 0.0f)
                stored.push_back({surface.position, point.geometric_normal, point.wo, path->power * scale});
        }
        if (scatter_photon(*path, surface, way_.specular_roughness, random) == PhotonTurn::ended) return;
    }
}

// Chunks are put together in their order, whichever thread traced them.
PhotonMap PhotonTracer::trace(int pass) const {
    const int count = source_.empty() ? 0 : settings_.photons;
    std::vector<std::vector<Photon>> chunks(std::size_t((count + chunk - 1) / chunk));
    parallel_for(chunks.size(), 1, [&](std::size_t c) {
        const int first = int(c) * chunk;
        for (int i = first; i < std::min(first + chunk, count); ++i) trace_photon(pass, i, chunks[c]);
    });
    std::vector<Photon> photons;
    for (const std::vector<Photon>& part : chunks) photons.insert(photons.end(), part.begin(), part.end());
    return PhotonMap(std::move(photons));
}

PhotonLight reflected_photons(const PhotonMap& map, const ShadingPoint& point, float radius) {
    PhotonLight light;
    if (map.size() == 0 || !point.has_smooth_lobes()) return light;
    const bool glossy = point.specular_chance > 0.0f && !point.mirror;
    const float r2 = radius * radius;
    glm::vec3 inner(0.0f), gloss(0.0f), inner_gloss(0.0f);
    map.within(point.surface->position, radius, [&](const Photon& photon, float d2) {
        if (glm::dot(photon.normal, point.geometric_normal) < same_side) return;
        light.whole += photon.power;
        if (d2 <= 0.5f * r2) inner += photon.power;
        const float cosine = glm::dot(point.normal, photon.direction);
        if (!glossy || cosine <= 0.0f) return;
        const glm::vec3 mirrored = photon.power * evaluate_bsdf(point, photon.direction).specular / cosine;
        gloss += mirrored;
        if (d2 <= 0.5f * r2) inner_gloss += mirrored;
    });
    const glm::vec3 diffuse = point.surface->brdf.diffuse / (shared::PI * shared::PI * r2);
    const float specular = 1.0f / (shared::PI * r2);
    light.whole = light.whole * diffuse + gloss * specular;
    inner = inner * (diffuse * 2.0f) + inner_gloss * (specular * 2.0f);
    light.bias = 2.0f * (light.whole - inner);
    return light;
}

} // namespace luxel
