// SPDX-License-Identifier: MIT
// Cameras from outside by the bounds, and from inside by trial.
#include "scene/views.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/error.h"
#include "scene/lights.h"
#include "shared/random.h"
#include "shared/sampling.h"

namespace luxel {
namespace {

constexpr int probe_columns = 16, probe_rows = 12;
constexpr int tries_per_view = 4000;
constexpr int area_light_samples = 64; // for emitters and for the environment

// Uniform number for one dimension of one try.
float draw(std::uint32_t seed, std::uint32_t attempt, std::uint32_t dimension, float least, float most) {
    return glm::mix(least, most, shared::uniform_float(shared::hash3(seed, attempt, dimension)));
}

// Somewhere in the middle of the bounds, any heading, roughly horizontal.
Camera random_camera(const Bounds& bounds, std::uint32_t seed, std::uint32_t attempt) {
    glm::vec3 share;
    for (int axis = 0; axis < 3; ++axis) share[axis] = draw(seed, attempt, std::uint32_t(axis), 0.05f, 0.95f);
    const float heading = draw(seed, attempt, 3, 0.0f, 2.0f * shared::PI);
    const float pitch = draw(seed, attempt, 4, -0.35f, 0.1f);
    Camera camera;
    camera.position = glm::mix(bounds.least, bounds.most, share);
    camera.forward = {std::cos(pitch) * std::sin(heading), std::sin(pitch),
                      -std::cos(pitch) * std::cos(heading)};
    return camera;
}

struct Point {
    glm::vec3 position, normal; // normal: geometric, unit, toward the viewer
};

struct Probe {
    int rays = 0, backs = 0, single_sided_backs = 0; // hits from behind
    int emitters = 0;
    std::vector<Point> points;
    std::vector<float> distances; // of the points
};

std::optional<Point> hit_point(const RayCaster& rays, const Ray& ray, Hit& hit) {
    if (!rays.intersect(ray, hit)) return std::nullopt;
    const glm::vec3 n = glm::normalize(hit.geometric_normal);
    return Point{ray.origin + ray.direction * hit.t, glm::dot(n, ray.direction) < 0.0f ? n : -n};
}

bool emits(const Material& material) { return material.emission != glm::vec3(0.0f); }

Probe look(const RayCaster& rays, const Camera& camera) {
    const Scene& scene = rays.scene();
    const CameraBasis basis = camera_basis(camera, probe_columns, probe_rows);
    Probe probe;
    for (int i = 0; i < probe_columns * probe_rows; ++i) {
        ++probe.rays;
        const glm::vec2 pixel(float(i % probe_columns) + 0.5f, float(i / probe_columns) + 0.5f);
        const glm::vec3 direction = pixel_direction(basis, probe_columns, probe_rows, pixel);
        Hit hit;
        const auto point = hit_point(rays, {camera.position, direction}, hit);
        if (!point) continue;
        probe.points.push_back(*point);
        probe.distances.push_back(hit.t * glm::length(direction));
        const Mesh& mesh = scene.meshes[std::size_t(scene.instances[hit.instance].mesh)];
        const Material& material = scene.materials[std::size_t(mesh.material)];
        if (emits(material)) ++probe.emitters;
        if (glm::dot(hit.geometric_normal, direction) <= 0.0f) continue;
        ++probe.backs;
        if (!material.double_sided) ++probe.single_sided_backs;
    }
    return probe;
}

float median(std::vector<float>& values) {
    const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

// How many of the points lie in the plane of one of them, at most.
int most_in_one_plane(const std::vector<Point>& points, float tolerance) {
    std::ptrdiff_t most = 0;
    for (const Point& p : points)
        most = std::max(most, std::count_if(points.begin(), points.end(), [&](const Point& q) {
                            return glm::dot(p.normal, q.normal) > 0.99f &&
                                   std::abs(glm::dot(p.normal, q.position - p.position)) < tolerance;
                        }));
    return int(most);
}

// Trial of views by what a grid of rays meets.
class Judge {
public:
    Judge(const RayCaster& rays, std::uint32_t seed)
        : rays_(rays), radius_(rays.scene().bounds().radius()), lights_(all_lights(rays.scene(), seed)),
          all_emit_(std::ranges::all_of(rays.scene().materials, emits)) {}

    bool accepts(const Camera& camera, std::uint32_t key) const {
        Probe probe = look(rays_, camera);

        // Open sky says nothing about light transport, and back faces are what the inside of a wall looks
        // like; some of two-sided materials are curtains and leaves.
        const int hits = int(probe.points.size());
        if (hits * 10 < probe.rays * 8) return false;
        if (probe.single_sided_backs * 20 > hits || probe.backs * 2 > hits) return false;
        if (median(probe.distances) <= 0.02f * radius_) return false;

        // A wall or a lamp that fills the view leaves too little to compare techniques by. In a room that
        // glows all over there is nothing else to see.
        if (probe.emitters * 10 > hits && !all_emit_) return false;
        if (most_in_one_plane(probe.points, 0.01f * radius_) * 10 > hits * 6) return false;
        return is_lit(probe, key);
    }

private:
    static std::vector<shared::Light> all_lights(const Scene& scene, std::uint32_t seed) {
        std::vector<shared::Light> lights = scene.lights;
        for (const auto& more : {emitter_sample_lights(scene, area_light_samples, seed),
                                 environment_sample_lights(scene.environment, area_light_samples, seed)})
            lights.insert(lights.end(), more.begin(), more.end());
        return lights;
    }

    // Whether one light, picked in proportion to what it would send there unoccluded, reaches the point.
    bool receives(const Point& point, std::uint32_t key) const {
        float sum = 0.0f;
        shared::LightSample picked{};
        for (const shared::Light& light : lights_) {
            const shared::LightSample s = shared::sample_light(light, point.position);
            const float weight = luminance(s.irradiance) * std::max(0.0f, glm::dot(s.wi, point.normal));
            sum += weight;
            key = shared::pcg(key);
            if (shared::uniform_float(key) * sum < weight) picked = s;
        }
        const float clear = 1e-4f * radius_;
        return sum > 0.0f && !rays_.occluded({point.position + point.normal * clear, picked.wi, 0.0f,
                                              picked.distance - 2.0f * clear});
    }

    // Cavities between the shells of a building look like corridors, but no light ever gets there, not even
    // by one bounce. Full shade with light around the corner is wanted, so a tenth of receiving paths is
    // enough.
    bool is_lit(const Probe& probe, std::uint32_t key) const {
        if (lights_.empty()) return true;
        int paths = 0, receiving = 0;
        for (const Point& point : probe.points) {
            const std::uint32_t a = shared::hash3(key, std::uint32_t(++paths), 1), b = shared::pcg(a),
                                c = shared::pcg(b);
            const glm::vec3 local =
                shared::sample_cosine_hemisphere({shared::uniform_float(a), shared::uniform_float(b)});
            const Ray bounce{point.position + point.normal * (1e-4f * radius_),
                             shared::frame_around(point.normal) * local};
            Hit hit;
            const auto second = hit_point(rays_, bounce, hit);
            receiving += receives(point, c) || (second && receives(*second, shared::pcg(c)));
        }
        return receiving * 10 >= paths;
    }

    const RayCaster& rays_;
    float radius_;
    std::vector<shared::Light> lights_;
    bool all_emit_;
};

} // namespace

std::vector<Camera> default_cameras(const Scene& scene) {
    const Bounds bounds = scene.bounds();
    const float radius = std::max(bounds.radius(), 1e-6f);
    std::vector<Camera> cameras;
    for (int i = 0; i < 3; ++i) {
        // A third of a turn apart and 25 degrees up; the bounding sphere just fits the vertical angle.
        const float heading = shared::PI * (1.0f / 6.0f + 2.0f / 3.0f * float(i)), elevation = 0.436f;
        const glm::vec3 outward(std::cos(elevation) * std::sin(heading), std::sin(elevation),
                                std::cos(elevation) * std::cos(heading));
        Camera camera;
        camera.name = "default " + std::to_string(i + 1);
        const float distance = radius / std::sin(camera.yfov * 0.5f);
        camera.position = bounds.center() + outward * distance;
        camera.forward = -outward;
        camera.near = (distance - radius) * 0.5f;
        cameras.push_back(camera);
    }
    return cameras;
}

std::vector<Camera> draw_views(const Scene& scene, const RayCaster& rays, int count, std::uint32_t seed) {
    LUXEL_ASSERT(count >= 0, "count={}", count);
    LUXEL_ASSERT(&scene == &rays.scene(), "the rays are of scene {}, not {}", rays.scene().name, scene.name);
    const Bounds bounds = scene.bounds();
    const Judge judge(rays, seed);
    std::vector<Camera> views;
    for (std::uint32_t attempt = 0; int(views.size()) < count; ++attempt) {
        if (attempt >= std::uint32_t(tries_per_view) * std::uint32_t(count))
            fail(Fault::bad_input,
                 "{}: views: only {} of {} views from inside were found; give cameras in the scene instead",
                 scene.name, views.size(), count);
        Camera camera = random_camera(bounds, seed, attempt);
        if (!judge.accepts(camera, shared::hash2(seed, attempt))) continue;
        camera.name = fmt::format("seed {} view {}", seed, views.size() + 1);
        camera.near = 5e-4f * bounds.radius();
        views.push_back(camera);
    }
    return views;
}

} // namespace luxel
