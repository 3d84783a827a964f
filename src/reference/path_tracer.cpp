// SPDX-License-Identifier: MIT
// Camera paths with next-event estimation: at every vertex the lights are sampled, and the ray that continues
// the path may find emitters too; the two are combined by the power heuristic [Veach1997, section 9.2.4].
#include "reference/path_tracer.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "reference/coverage.h"
#include "scene/thin_sheets.h"
#include "shared/sampling.h"

namespace luxel {
namespace {

constexpr int roulette_vertex = 4;
constexpr float roulette_share = 0.25f;

float largest(glm::vec3 v) { return std::max(std::max(v.x, v.y), v.z); }

} // namespace

WantedComponents::WantedComponents(const std::vector<std::string>& names, CausticMethod caustic_method) {
    for (const std::string& name : names) {
        bool full = name == "full";
        direct |= full || name == "direct";
        diffuse1 |= name == "diffuse1";
        diffuse1_unoccluded |= name == "diffuse1_unoccluded";
        diffuse |= full || name == "diffuse";
        specular |= full || name == "specular";
        reflections |= name == "reflections";
        caustics |= name == "caustics" && caustic_method == CausticMethod::paths;
        ao |= name == "ao";
    }
}

PathTracer::PathTracer(const RayCaster& rays, const ReferenceRequest& request,
                       const PathTracerOptions& options)
    : rays_(&rays), scene_(&rays.scene()), settings_(request.settings),
      wanted_(request.components, request.settings.caustic_method), options_(options), lights_(rays.scene()),
      camera_(camera_basis(request.camera, request.width, request.height)), near_(request.camera.near),
      far_(request.camera.far), width_(request.width), height_(request.height) {}

Ray PathTracer::camera_ray(glm::vec2 pixel) const {
    return {pixel_origin(camera_, width_, height_, pixel), pixel_direction(camera_, width_, height_, pixel),
            near_, far_};
}

bool PathTracer::intersect_seen(const Ray& ray, Hit& hit) const {
    if (options_.log) options_.log->entries.push_back({ray, false});
    return rays_->intersect_seen(ray, hit);
}

bool PathTracer::intersect(const Ray& ray, Hit& hit) const {
    if (options_.log) options_.log->entries.push_back({ray, false});
    return rays_->intersect(ray, hit);
}

// Whether light that the last surface reflects belongs to a component that was asked for.
bool PathTracer::is_wanted(const Path& path, bool by_ideal_lobe) const {
    if (path.vertex == 1 && !by_ideal_lobe) return wanted_.direct;
    if (wanted_.specular) return true;
    if (wanted_.reflections && is_reflection(path.vertex - (by_ideal_lobe ? 0 : 1)) &&
        path.reflected + path.reflected_smooth != glm::vec3(0.0f))
        return true;
    if (wanted_.caustics && path.vertex >= 2 && path.caustic != glm::vec3(0.0f)) return true;
    return path.diffuse != glm::vec3(0.0f) && (wanted_.diffuse || (wanted_.diffuse1 && path.vertex == 2));
}

// The same for surfaces still to come.
bool PathTracer::more_is_wanted(const Path& path) const {
    if (path.vertex > settings_.max_bounces) return false;
    if (wanted_.specular) return true;
    if (wanted_.reflections && is_reflection(path.vertex) && path.reflected != glm::vec3(0.0f)) return true;
    if (wanted_.caustics && path.caustic != glm::vec3(0.0f)) return true;
    return path.diffuse != glm::vec3(0.0f) && (wanted_.diffuse || (wanted_.diffuse1 && path.vertex == 1));
}

bool PathTracer::go_on(Path& path, const ShadingPoint& point) const {
    const BsdfSample sample = sample_bsdf(point, path.random);
    // Light samples of a surface look through thin sheets, so that for its own rays they are no vertices
    // either. Before the first such surface a sheet is glass that the camera looks through.
    return sample.straight && path.after_smooth ? pass_straight(path, point, sample)
                                                : scatter(path, point, sample);
}

bool PathTracer::pass_straight(Path& path, const ShadingPoint& point, const BsdfSample& sample) const {
    --path.vertex;
    for (glm::vec3* throughput :
         {&path.beta, &path.diffuse, &path.reflected, &path.reflected_smooth, &path.caustic})
        *throughput *= sample.weight;
    path.ray = {point.origin(sample.wi), sample.wi};
    return path.beta != glm::vec3(0.0f);
}

bool PathTracer::scatter(Path& path, const ShadingPoint& point, const BsdfSample& sample) const {
    path.from = {point.surface->position, point.receiving_normal()};
    path.beta *= sample.weight;
    path.diffuse *= sample.diffuse;
    const bool specular = sample.ideal || has_specular_ggx(*point.surface, settings_.specular_roughness);
    const glm::vec3 by_specular = specular ? sample.weight - sample.diffuse : glm::vec3(0.0f);
    path.reflected_smooth = path.reflected * sample.weight;
    path.reflected *= by_specular;
    path.caustic *= path.vertex == 1 ? sample.diffuse : by_specular;
    path.pdf = sample.pdf;
    path.ideal = sample.ideal;
    path.after_smooth |= !sample.ideal;
    bool can_meet_light =
        (lights_.has_emitters() || lights_.has_environment()) && is_wanted(path, path.ideal);
    if (path.beta == glm::vec3(0.0f) || !(can_meet_light || more_is_wanted(path))) return false;

    // Russian roulette once a path has lost most of its light; survivors keep the throughput roulette_share.
    // Any share is unbiased. Measured on the Cornell box, 1 / (variance x time) is the same within 10 % from
    // 1 to .1, while bright closed rooms, whose paths differ in nothing but their length, gain by smaller
    // ones.
    if (path.vertex >= roulette_vertex) {
        float survival =
            std::min(1.0f, largest(wanted_.specular_lobes() ? path.beta : path.diffuse) / roulette_share);
        if (path.random.next() >= survival) return false;
        for (glm::vec3* throughput :
             {&path.beta, &path.diffuse, &path.reflected, &path.reflected_smooth, &path.caustic})
            *throughput /= survival;
    }
    path.media.leave(*point.surface, sample.wi);
    path.ray = {point.origin(sample.wi), sample.wi};
    return true;
}

void PathTracer::send(Path& path, const FirstVertex* known) const {
    if (known)
        path.hit = known->hit, path.found = known->found;
    else
        path.found = path.vertex == 0 ? intersect_seen(path.ray, path.hit) : intersect(path.ray, path.hit);
    if (path.found && !camera_.orthographic) path.length += path.hit.t;
}

Path PathTracer::start(int x, int y, int sample, const FirstVertex* first, const PhotonPass* photons) const {
    const shared::uint pixel = shared::uint(y) * shared::uint(width_) + shared::uint(x);
    Path path{Random(pixel, shared::uint(sample), shared::uint(settings_.seed))};
    glm::vec2 jitter = settings_.pixel_center ? glm::vec2(0.5f) : path.random.next2();
    path.ray = camera_ray(glm::vec2(x, y) + jitter);
    path.from.position = path.ray.origin;
    path.length = camera_.orthographic ? 1.0f : 0.0f;
    path.first = first;
    path.photons = photons;
    send(path, first);
    return path;
}

// What the ray meets was sent by the last vertex: by an ideal lobe, or it is the other half of the light that
// this vertex reflects straight from its sources.
void PathTracer::add_met(Path& path, glm::vec3 met) const {
    const bool by_photons =
        path.photons && settings_.photon_lights == PhotonLights::all && path.ideal && path.after_smooth;
    if (!by_photons) path.add(path.beta * met, path.diffuse * met, path.ideal);
    if (is_reflection(path.ideal ? path.vertex : path.vertex - 1))
        path.result.reflections += (path.ideal ? path.reflected : path.reflected_smooth) * met;
    if (path.vertex >= 2) path.result.caustics += path.caustic * met;
}

void PathTracer::add_lit(Path& path, const Surface& surface, const BsdfValue& lit) const {
    path.add(path.beta * lit.sum(), path.diffuse * lit.diffuse, false);
    if (is_reflection(path.vertex - 1)) path.result.reflections += path.reflected * lit.sum();
    if (path.vertex >= 2 && has_specular_ggx(surface, settings_.specular_roughness))
        path.result.caustics += path.caustic * lit.specular;
}

// Light that passed mirrors or glass on its way from the lights to this surface.
void PathTracer::add_photons(Path& path, const ShadingPoint& point) const {
    if (!path.photons) return;
    const PhotonLight light = reflected_photons(path.photons->map, point, path.photons->radius * path.length);
    path.result.specular += path.beta * light.whole;
    path.result.photon_bias += path.beta * light.bias;
}

// Light on the present ray has come through what the path is inside of.
void PathTracer::absorb(Path& path, const Surface* met) const {
    const float distance =
        met ? path.hit.t * glm::length(path.ray.direction) : std::numeric_limits<float>::infinity();
    const glm::vec3 left = path.media.transmittance(distance, met);
    if (left == glm::vec3(1.0f)) return;
    for (glm::vec3* throughput :
         {&path.beta, &path.diffuse, &path.reflected, &path.reflected_smooth, &path.caustic})
        *throughput *= left;
}

// Alpha is coverage: so much of the light meets the surface, the rest goes on as if it were not there.
bool PathTracer::passes_uncovered(Path& path, const Surface& surface) const {
    if (surface.coverage >= 1.0f || path.random.next() < surface.coverage) return false;
    absorb(path, &surface);
    path.first = nullptr; // which knows the nearest surface only
    go_behind(path.ray, path.hit, surface);
    send(path);
    path.alive = true;
    return true;
}

// Past all surfaces there is the environment.
void PathTracer::finish(Path& path) const {
    if (!path.media.empty()) absorb(path, nullptr);
    add_met(path, environment_met(path.ray.direction, path.pdf));
    path.alive = false;
}

// Light that reaches the path's present surface straight from its sources.
BsdfValue PathTracer::lit_by_lights(Path& path, const ShadingPoint& point) const {
    const FirstVertex* first = path.vertex == 1 ? path.first : nullptr;
    const bool all_known = first && first->lit_by_all;
    LightSamples samples;
    sample_lights(point, all_known ? 0 : path.vertex == 1 ? first_draws : later_draws, path.random, samples);
    BsdfValue lit = visible_light(point, samples);
    if (all_known) lit.diffuse += first->lit.diffuse, lit.specular += first->lit.specular;
    return lit;
}

// Whether nothing that was asked for depends on where the other lobes would send the path. (Emission that
// direct light finds by their sampling does.)
bool PathTracer::only_lambertian_matters(const Path& path) const {
    if (wanted_.specular_lobes()) return false;
    return path.vertex > 1 || !wanted_.direct || (!lights_.has_emitters() && !lights_.has_environment());
}

void PathTracer::step(Path& path) const {
    if (!path.found) return finish(path);
    path.alive = false;

    // The surface may emit.
    Surface surface = path.first && path.vertex == 0 ? path.first->surface
                                                     : surface_at(*scene_, path.hit, path.ray.direction);
    if (passes_uncovered(path, surface)) return;
    absorb(path, &surface);
    add_met(path, emission_met(path.hit, surface, path.from, path.ray.direction, path.pdf));
    ++path.vertex;
    const bool sheet = path.after_smooth && is_clear_sheet(surface);
    const bool lambertian = !sheet && only_lambertian_matters(path);
    if (lambertian && path.vertex > 1) surface = lambertian_part(surface);
    ShadingPoint point(surface, path.ray.direction);
    if (path.vertex == 1) add_first_vertex(point, path.random, path.result);
    if (path.vertex <= settings_.max_bounces + 1) add_photons(path, point);
    const bool lit_is_wanted = path.vertex <= settings_.max_bounces + 1 && is_wanted(path, false);
    if (!lit_is_wanted && !more_is_wanted(path) && !sheet) return;

    // It reflects light that comes straight from its sources, and light from the next surface.
    if (lit_is_wanted) add_lit(path, surface, lit_by_lights(path, point));
    if (lambertian && path.vertex == 1) {
        surface = lambertian_part(surface);
        point = ShadingPoint(surface, path.ray.direction);
    }
    if (!go_on(path, point)) return;
    send(path);
    path.alive = true;
}

// Paths side by side: what their next surfaces need from memory is asked for at once instead of one after the
// other.
void PathTracer::follow(std::span<Path> paths) const {
    bool any = true;
    while (any) {
        for (const Path& path : paths)
            if (path.alive && path.found) load_triangle(path.hit);
        for (const Path& path : paths)
            if (path.alive && path.found) prefetch_texels(*scene_, path.hit);
        any = false;
        for (Path& path : paths)
            if (path.alive) step(path), any |= path.alive;
    }
}

PathSample PathTracer::trace(int x, int y, int sample) const {
    Path path = start(x, y, sample, nullptr, nullptr);
    follow({&path, 1});
    return path.result;
}

} // namespace luxel
