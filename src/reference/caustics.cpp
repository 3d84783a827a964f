// SPDX-License-Identifier: MIT
#include "reference/caustics.h"
#include "reference/coverage.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"

namespace luxel {
namespace {

constexpr shared::uint photon_seed = 0x70686f74u; // parts the photons' random numbers from the pixels'

} // namespace

CausticTracer::CausticTracer(const RayCaster& rays, const ReferenceRequest& request)
    : rays_(&rays), settings_(request.settings),
      camera_(camera_basis(request.camera, request.width, request.height)), near_(request.camera.near),
      far_(request.camera.far), width_(request.width), height_(request.height),
      pixel_(camera_.pixel_side(request.height, 1.0f)),
      photons_(rays, request.settings,
               {request.settings.specular_roughness, false, photon_seed, [this](const Surface& surface) {
                    return surface.brdf.diffuse != glm::vec3(0.0f) && may_be_seen(surface.position);
                }}) {
    const float half = std::min(glm::length(camera_.up), glm::length(camera_.right));
    if (camera_.orthographic) {
        seen_ = 1.0f + settings_.photon_radius * pixel_ / half;
        return;
    }

    // A sphere of r pixels at the image's corner covers r pixels of a plane across the view, stretched by the
    // angle and by its own depth: 1 / (1 - r pixel) bounds that.
    const float radius = settings_.photon_radius * pixel_;
    const float corner =
        std::sqrt(1.0f + glm::dot(camera_.up, camera_.up) + glm::dot(camera_.right, camera_.right));
    seen_ = radius < 0.5f ? 1.0f + radius * corner / (1.0f - radius) / half : 1e30f;
}

bool CausticTracer::may_be_seen(glm::vec3 position) const {
    const glm::vec3 d = position - camera_.position;
    const float z = glm::dot(d, camera_.forward);
    const float x = glm::dot(d, camera_.right) / glm::dot(camera_.right, camera_.right),
                y = glm::dot(d, camera_.up) / glm::dot(camera_.up, camera_.up);
    const float wide = camera_.orthographic ? seen_ : seen_ * z;
    return seen_ >= 1e30f || (z > 0.0f && std::abs(x) <= wide && std::abs(y) <= wide);
}

// Density of the photons around what the pixel sees.
void CausticTracer::gather(const PhotonMap& map, int pass, int x, int y, const Sink& sink) const {
    const shared::uint pixel = shared::uint(y) * shared::uint(width_) + shared::uint(x);
    Random random(pixel, shared::uint(pass), shared::uint(settings_.seed));
    const glm::vec2 jitter = settings_.pixel_center ? glm::vec2(0.5f) : random.next2();
    const glm::vec2 at = glm::vec2(x, y) + jitter;
    Ray ray{pixel_origin(camera_, width_, height_, at), pixel_direction(camera_, width_, height_, at), near_,
            far_};
    Hit hit;
    float passed = 0.0f;
    if (map.size() == 0 || !intersect_covered(*rays_, ray, hit, random, passed, true))
        return sink(x, y, glm::vec3(0.0f), glm::vec3(0.0f));
    const Surface surface = lambertian_part(surface_at(rays_->scene(), hit, ray.direction));
    const float radius = settings_.photon_radius * relative_photon_radius(pass) * pixel_ *
                         (camera_.orthographic ? 1.0f : passed + hit.t);
    const PhotonLight light = reflected_photons(map, ShadingPoint(surface, ray.direction), radius);
    sink(x, y, light.whole, light.bias);
}

void CausticTracer::trace_pass(int pass, const Sink& sink) const {
    const PhotonMap map = photons_.trace(pass);
    parallel_for(std::size_t(height_), 1, [&](std::size_t y) {
        for (int x = 0; x < width_; ++x) gather(map, pass, x, int(y), sink);
    });
}

} // namespace luxel
