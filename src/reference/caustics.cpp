// SPDX-License-Identifier: MIT
#include "reference/caustics.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"
#include "shared/brdf.h"

namespace luxel {
namespace {

constexpr double alpha = 2.0 / 3.0;
constexpr int chunk = 1024;                       // photons that are traced in one go
constexpr float same_side = 0.5f;                 // least cosine between the normals of photon and pixel
constexpr shared::uint photon_seed = 0x70686f74u; // parts the photons' random numbers from the pixels'

} // namespace

// r_i^2 / r_1^2 = product of (k + alpha) / (k + 1) for k < i = gamma(i + alpha) / (gamma(i + 1) gamma(1 +
// alpha))
float relative_photon_radius(int pass) {
    const double i = pass + 1.0;
    return float(std::exp(0.5 * (std::lgamma(i + alpha) - std::lgamma(i + 1.0) - std::lgamma(1.0 + alpha))));
}

CausticTracer::CausticTracer(const RayCaster& rays, const ReferenceRequest& request)
    : rays_(&rays), settings_(request.settings), source_(rays, request.settings.specular_roughness),
      camera_(camera_basis(request.camera, request.width, request.height)), near_(request.camera.near),
      far_(request.camera.far), width_(request.width), height_(request.height),
      pixel_(2.0f * glm::length(camera_.up) / float(request.height)) {
    // A sphere of r pixels at the image's corner covers r pixels of a plane across the view, stretched by the
    // angle and by its own depth: 1 / (1 - r pixel) bounds that.
    const float radius = settings_.photon_radius * pixel_;
    const float corner =
        std::sqrt(1.0f + glm::dot(camera_.up, camera_.up) + glm::dot(camera_.right, camera_.right));
    const float half = std::min(glm::length(camera_.up), glm::length(camera_.right));
    seen_ = radius < 0.5f ? 1.0f + radius * corner / (1.0f - radius) / half : 1e30f;
}

bool CausticTracer::may_be_seen(glm::vec3 position) const {
    const glm::vec3 d = position - camera_.position;
    const float z = glm::dot(d, camera_.forward);
    const float x = glm::dot(d, camera_.right) / glm::dot(camera_.right, camera_.right),
                y = glm::dot(d, camera_.up) / glm::dot(camera_.up, camera_.up);
    return seen_ >= 1e30f || (z > 0.0f && std::abs(x) <= seen_ * z && std::abs(y) <= seen_ * z);
}

// Its path through specular surfaces; wherever it meets a Lambertian lobe, that is where a caustic is.
void CausticTracer::trace_photon(int pass, int index, std::vector<Photon>& stored) const {
    Random random(shared::uint(pass), shared::uint(index),
                  shared::hash2(shared::uint(settings_.seed), photon_seed));
    std::optional<PhotonPath> path = source_.start(random);
    if (!path) return;
    for (int vertex = 1; vertex <= settings_.max_bounces; ++vertex) {
        Hit hit;
        if (!rays_->intersect(path->ray, hit)) return;
        const Surface surface = surface_at(rays_->scene(), hit, path->ray.direction);
        if (surface.brdf.diffuse != glm::vec3(0.0f) && may_be_seen(surface.position)) {
            // Power over area is irradiance of the geometric surface; what is reflected goes by the shading
            // normal.
            const ShadingPoint point(surface, path->ray.direction);
            const float geometric = glm::dot(point.geometric_normal, point.wo);
            const float scale = glm::dot(point.normal, point.wo) / (geometric * float(settings_.photons));
            if (geometric > 0.0f)
                stored.push_back({surface.position, point.geometric_normal, path->power * scale});
        }
        if (!scatter_photon(*path, surface, settings_.specular_roughness, random)) return;
    }
}

// Chunks are put together in their order, whichever thread traced them.
PhotonMap CausticTracer::trace_photons(int pass) const {
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

// Density of the photons around what the pixel sees. With the error of a radius r growing as r^2, twice the
// difference to the radius r / sqrt 2 is that error.
void CausticTracer::gather(const PhotonMap& map, int pass, int x, int y, const Sink& sink) const {
    const shared::uint pixel = shared::uint(y) * shared::uint(width_) + shared::uint(x);
    Random random(pixel, shared::uint(pass), shared::uint(settings_.seed));
    const glm::vec2 jitter = settings_.pixel_center ? glm::vec2(0.5f) : random.next2();
    const Ray ray{camera_.position, pixel_direction(camera_, width_, height_, glm::vec2(x, y) + jitter),
                  near_, far_};
    glm::vec3 whole(0.0f), inner(0.0f);
    Hit hit;
    if (map.size() == 0 || !rays_->intersect(ray, hit)) return sink(x, y, whole, inner);
    const Surface surface = surface_at(rays_->scene(), hit, ray.direction);
    if (surface.brdf.diffuse == glm::vec3(0.0f)) return sink(x, y, whole, inner);

    const ShadingPoint point(surface, ray.direction);
    const float radius = settings_.photon_radius * relative_photon_radius(pass) * pixel_ * hit.t;
    const float r2 = radius * radius;
    map.within(surface.position, radius, [&](const Photon& photon, float d2) {
        if (glm::dot(photon.normal, point.geometric_normal) < same_side) return;
        whole += photon.power;
        if (d2 <= 0.5f * r2) inner += photon.power;
    });
    const glm::vec3 reflected = surface.brdf.diffuse / (shared::PI * shared::PI * r2);
    whole *= reflected, inner *= reflected * 2.0f;
    sink(x, y, whole, 2.0f * (whole - inner));
}

void CausticTracer::trace_pass(int pass, const Sink& sink) const {
    const PhotonMap map = trace_photons(pass);
    parallel_for(std::size_t(height_), 1, [&](std::size_t y) {
        for (int x = 0; x < width_; ++x) gather(map, pass, x, int(y), sink);
    });
}

} // namespace luxel
