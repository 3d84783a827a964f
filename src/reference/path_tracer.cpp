// SPDX-License-Identifier: MIT
// Camera paths with next-event estimation: at every vertex the lights are sampled, and the ray that continues
// the path may find emitters too; the two are combined by the power heuristic [Veach1997, section 9.2.4].
#include "reference/path_tracer.h"

#include <algorithm>
#include <cmath>

#include "shared/sampling.h"

namespace luxel {
namespace {

constexpr std::size_t all_lights_limit = 4; // up to so many punctual lights, each is sampled at each vertex
constexpr int roulette_vertex = 4;
constexpr float roulette_share = 0.25f;

float power_heuristic(float pdf, float other) {
    float a = pdf * pdf, b = other * other;
    if (!std::isfinite(a)) return 1.0f; // a far sharper density than the other can be
    return a > 0.0f ? a / (a + b) : 0.0f;
}

float largest(glm::vec3 v) { return std::max(std::max(v.x, v.y), v.z); }

} // namespace

WantedComponents::WantedComponents(const std::vector<std::string>& names) {
    for (const std::string& name : names) {
        bool full = name == "full";
        direct |= full || name == "direct";
        diffuse1 |= name == "diffuse1";
        diffuse1_unoccluded |= name == "diffuse1_unoccluded";
        diffuse |= full || name == "diffuse";
        specular |= full || name == "specular";
        ao |= name == "ao";
    }
}

// The state of one camera path.
struct PathTracer::Path {
    Path(shared::uint pixel, int sample, int seed)
        : random(pixel, shared::uint(sample), shared::uint(seed)) {}

    Random random;
    Ray ray;
    PathSample result;
    int vertex = 0;           // surfaces met so far
    glm::vec3 beta{1.0f};     // throughput of all lobes
    glm::vec3 diffuse{1.0f};  // throughput if every vertex so far reflected by its Lambertian lobe
    bool after_ideal = false; // the last vertex was an ideal lobe
    float pdf = 0.0f;         // of the ray, where the last vertex was smooth

    // Light that the last of `vertex` surfaces sends along the path: `all` lobes of it, `lambert` its diffuse
    // part, the throughputs of what lies before included.
    void add(glm::vec3 all, glm::vec3 lambert) {
        if (vertex == 0 || (vertex == 1 && !after_ideal)) {
            result.direct += all;
            return;
        }
        result.diffuse += lambert;
        if (vertex == 2) result.diffuse1 += lambert;
        result.specular += all - lambert;
    }
};

PathTracer::PathTracer(const RayCaster& rays, const ReferenceRequest& request,
                       const PathTracerOptions& options)
    : rays_(&rays), scene_(&rays.scene()), settings_(request.settings), wanted_(request.components),
      options_(options), lights_(rays.scene()),
      camera_(camera_basis(request.camera, request.width, request.height)), near_(request.camera.near),
      far_(request.camera.far), width_(request.width), height_(request.height) {}

Ray PathTracer::camera_ray(glm::vec2 pixel) const {
    return {camera_.position, pixel_direction(camera_, width_, height_, pixel), near_, far_};
}

bool PathTracer::intersect(const Ray& ray, Hit& hit) const {
    if (options_.log) options_.log->entries.push_back({ray, false});
    return rays_->intersect(ray, hit);
}

bool PathTracer::occluded(const ShadingPoint& point, const LightArrival& light) const {
    Ray ray{point.origin(light.wi), light.wi};
    if (!light.infinite) {
        // Punctual lights may touch the lamp that holds them; points on emitters are already moved off.
        ray.direction = light.target - ray.origin;
        ray.t_max = light.pdf > 0.0f ? 1.0f : 0.9999f;
    }
    if (options_.log) options_.log->entries.push_back({ray, true});
    return rays_->occluded(ray);
}

bool PathTracer::sees_surface(int x, int y) const {
    Hit hit;
    return rays_->intersect(camera_ray({float(x) + 0.5f, float(y) + 0.5f}), hit);
}

// --- light at a vertex ---

void PathTracer::add_arrival(const ShadingPoint& point, const LightArrival& light, BsdfValue& sum) const {
    if (light.radiance == glm::vec3(0.0f)) return;
    BsdfValue value = evaluate_bsdf(point, light.wi);
    if (value.sum() == glm::vec3(0.0f) || occluded(point, light)) return;
    float weight = 1.0f;
    if (light.pdf > 0.0f && options_.strategy == Strategy::mis)
        weight = power_heuristic(light.pdf, value.pdf);
    sum.diffuse += value.diffuse * light.radiance * weight;
    sum.specular += value.specular * light.radiance * weight;
}

// A few lights are all summed. Of many, some are drawn in proportion to what they would send: more at the
// first vertex, whose noise is seen directly.
void PathTracer::add_punctual(const ShadingPoint& point, bool first, Random& random, BsdfValue& sum) const {
    std::size_t count = lights_.punctual_count();
    if (count <= all_lights_limit) {
        for (std::size_t i = 0; i < count; ++i)
            add_arrival(point, lights_.punctual(i, point.surface->position), sum);
        return;
    }
    thread_local std::vector<float> cumulative;
    float u = random.next();
    if (!lights_.choose_among(point, cumulative)) return;
    int draws = first ? int(all_lights_limit) : 1;
    for (int i = 0; i < draws; ++i) {
        std::size_t chosen = find_in(cumulative, (float(i) + u) / float(draws));
        float chance =
            (cumulative[chosen] - (chosen > 0 ? cumulative[chosen - 1] : 0.0f)) / cumulative.back();
        if (chance <= 0.0f) continue;
        LightArrival light = lights_.punctual(chosen, point.surface->position);
        light.radiance /= chance * float(draws);
        add_arrival(point, light, sum);
    }
}

BsdfValue PathTracer::direct_light(const ShadingPoint& point, std::size_t emitter, bool first,
                                   Random& random) const {
    BsdfValue sum;
    if (!point.has_smooth_lobes()) return sum;
    add_punctual(point, first, random, sum);
    if (options_.strategy == Strategy::bsdf_only) return sum;
    if (lights_.has_emitters())
        add_arrival(point, lights_.sample_emitter(emitter, point.surface->position, random.next2()), sum);
    if (lights_.has_environment()) add_arrival(point, lights_.sample_environment(random.next2()), sum);
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

glm::vec3 PathTracer::emission_met(const Hit& hit, const Surface& surface, glm::vec3 from, glm::vec3 wi,
                                   float bsdf_pdf) const {
    if (surface.emission == glm::vec3(0.0f)) return glm::vec3(0.0f);
    if (!surface.front && !surface.material->double_sided) return glm::vec3(0.0f);
    if (bsdf_pdf <= 0.0f || options_.strategy == Strategy::bsdf_only) return surface.emission;
    float light_pdf = lights_.emitter_pdf(hit, surface, from, wi);
    if (options_.strategy == Strategy::lights_only)
        return light_pdf > 0.0f ? glm::vec3(0.0f) : surface.emission;
    return surface.emission * power_heuristic(bsdf_pdf, light_pdf);
}

// --- the path ---

// Whether light that the last surface reflects belongs to a component that was asked for.
bool PathTracer::is_wanted(const Path& path) const {
    if (path.vertex == 1 && !path.after_ideal) return wanted_.direct;
    if (wanted_.specular) return true;
    return path.diffuse != glm::vec3(0.0f) && (wanted_.diffuse || (wanted_.diffuse1 && path.vertex == 2));
}

// The same for surfaces still to come.
bool PathTracer::more_is_wanted(const Path& path) const {
    if (path.vertex > settings_.max_bounces) return false;
    if (wanted_.specular) return true;
    return path.diffuse != glm::vec3(0.0f) && (wanted_.diffuse || (wanted_.diffuse1 && path.vertex == 1));
}

// Continues the path from `point`; false where it ends.
bool PathTracer::scatter(Path& path, const ShadingPoint& point) const {
    BsdfSample sample = sample_bsdf(point, path.random);
    path.beta *= sample.weight;
    path.diffuse *= sample.diffuse;
    path.pdf = sample.pdf;
    path.after_ideal = sample.ideal;
    bool can_meet_light = (lights_.has_emitters() || lights_.has_environment()) && is_wanted(path);
    if (path.beta == glm::vec3(0.0f) || !(can_meet_light || more_is_wanted(path))) return false;

    // Russian roulette: survive with the share of light that is left, so that the survivors' throughput stays
    // near 1.
    if (path.vertex >= roulette_vertex) {
        float survival =
            std::min(1.0f, 1.0f / roulette_share * largest(wanted_.specular ? path.beta : path.diffuse));
        if (path.random.next() >= survival) return false;
        path.beta /= survival;
        path.diffuse /= survival;
    }
    path.ray = {point.origin(sample.wi), sample.wi};
    return true;
}

void PathTracer::follow(Path& path) const {
    glm::vec3 from = path.ray.origin;
    while (true) {
        // What the ray meets: the environment, or a surface that may emit.
        std::size_t emitter = lights_.has_emitters() ? lights_.choose_emitter(path.random.next()) : 0;
        Hit hit;
        if (!intersect(path.ray, hit)) {
            glm::vec3 met = environment_met(path.ray.direction, path.pdf);
            path.add(path.beta * met, path.diffuse * met);
            return;
        }
        Surface surface = surface_at(*scene_, hit, path.ray.direction);
        glm::vec3 met = emission_met(hit, surface, from, path.ray.direction, path.pdf);
        path.add(path.beta * met, path.diffuse * met);
        ++path.vertex;

        // What it reflects of light that comes straight from its sources.
        if (path.vertex > settings_.max_bounces + 1) return;
        ShadingPoint point(surface, path.ray.direction);
        path.after_ideal = false;
        if (path.vertex == 1) {
            if (wanted_.ao) path.result.ao = openness(point, path.random);
            if (wanted_.diffuse1_unoccluded)
                path.result.diffuse1_unoccluded = unoccluded_bounce(point, path.random);
        }
        if (is_wanted(path)) {
            BsdfValue lit = direct_light(point, emitter, path.vertex == 1, path.random);
            path.add(path.beta * lit.sum(), path.diffuse * lit.diffuse);
        } else if (!more_is_wanted(path)) {
            return;
        }

        from = surface.position;
        if (!scatter(path, point)) return;
    }
}

PathSample PathTracer::trace(int x, int y, int sample) const {
    Path path(shared::uint(y) * shared::uint(width_) + shared::uint(x), sample, settings_.seed);
    glm::vec2 jitter = settings_.pixel_center ? glm::vec2(0.5f) : path.random.next2();
    path.ray = camera_ray(glm::vec2(x, y) + jitter);
    follow(path);
    return path.result;
}

// --- components with a ray of their own at the first vertex ---

// Share of the cosine-weighted hemisphere without an occluder within the radius, occluders weighted by
// distance.
float PathTracer::openness(const ShadingPoint& point, Random& random) const {
    glm::vec3 wi = shared::frame_around(point.normal) * shared::sample_cosine_hemisphere(random.next2());
    if (glm::dot(wi, point.geometric_normal) <= 0.0f) return 0.0f;
    Ray ray{point.origin(wi), wi, 0.0f, settings_.ao_radius};
    Hit hit;
    if (!intersect(ray, hit)) return 1.0f;
    float d = std::min(hit.t / settings_.ao_radius, 1.0f);
    switch (settings_.ao_membership) {
    case Membership::sqrt:
        return std::sqrt(d);
    case Membership::cubic:
        return d * d * d;
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
        if (surface.front || surface.material->double_sided) sum += diffuse_reflection(surface, wi, random);
        ShadingPoint layer(surface, wi);
        ray.origin = layer.origin(wi);
    }
    return albedo * sum;
}

// Light straight from its sources that the Lambertian lobe sends back along `direction`.
glm::vec3 PathTracer::diffuse_reflection(const Surface& surface, glm::vec3 direction, Random& random) const {
    // As if it had no other lobe, so that the one direction drawn for MIS is a diffuse one.
    Surface lambertian = surface;
    lambertian.brdf.f0 = lambertian.brdf.f90 = glm::vec3(0.0f);
    lambertian.transmission = 0.0f;
    ShadingPoint point(lambertian, direction);
    if (!point.has_smooth_lobes()) return glm::vec3(0.0f);
    std::size_t emitter = lights_.has_emitters() ? lights_.choose_emitter(random.next()) : 0;
    glm::vec3 sum = direct_light(point, emitter, false, random).diffuse;
    if (!lights_.has_emitters() && !lights_.has_environment()) return sum;

    BsdfSample sample = sample_bsdf(point, random);
    if (sample.weight == glm::vec3(0.0f)) return sum;
    Ray ray{point.origin(sample.wi), sample.wi};
    Hit hit;
    if (!intersect(ray, hit)) return sum + sample.weight * environment_met(sample.wi, sample.pdf);
    Surface met = surface_at(*scene_, hit, sample.wi);
    return sum + sample.weight * emission_met(hit, met, surface.position, sample.wi, sample.pdf);
}

} // namespace luxel
