// SPDX-License-Identifier: MIT
// Cameras from outside by the bounds, and from inside by trial.
#include "scene/views.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "scene/surface.h"
#include "shared/random.h"

namespace luxel {
namespace {

constexpr int probe_columns = 16, probe_rows = 12;
constexpr int tries_per_view = 4000;

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

struct Probe {
    int rays = 0, hits = 0, backs = 0; // backs: of single-sided surfaces
    std::vector<float> distances;      // of the hits
};

void look(const Scene& scene, const RayCaster& rays, glm::vec3 origin, glm::vec3 direction, Probe& probe) {
    ++probe.rays;
    Hit hit;
    if (!rays.intersect({origin, direction}, hit)) return;
    ++probe.hits;
    probe.distances.push_back(hit.t * glm::length(direction));
    const Mesh& mesh = scene.meshes[std::size_t(scene.instances[hit.instance].mesh)];
    const bool back = glm::dot(hit.geometric_normal, direction) > 0.0f;
    if (back && !scene.materials[std::size_t(mesh.material)].double_sided) ++probe.backs;
}

// The distance that a share of the hits lies below.
float quantile(std::vector<float>& distances, float share) {
    const auto place = distances.begin() + std::ptrdiff_t(float(distances.size() - 1) * share);
    std::nth_element(distances.begin(), place, distances.end());
    return *place;
}

bool is_valid(const Scene& scene, const RayCaster& rays, const Camera& camera, float radius) {
    Probe probe;
    const CameraBasis basis = camera_basis(camera, probe_columns, probe_rows);
    for (int y = 0; y < probe_rows; ++y)
        for (int x = 0; x < probe_columns; ++x)
            look(scene, rays, camera.position,
                 pixel_direction(basis, probe_columns, probe_rows, {float(x) + 0.5f, float(y) + 0.5f}),
                 probe);

    // Open sky says nothing about light transport, and back faces are what the inside of a wall looks like.
    if (probe.hits * 10 < probe.rays * 8 || probe.backs * 20 > probe.hits) return false;
    return quantile(probe.distances, 0.5f) > 0.02f * radius;
}

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
        camera.far = distance + 2.0f * radius;
        cameras.push_back(camera);
    }
    return cameras;
}

std::vector<Camera> draw_views(const Scene& scene, const RayCaster& rays, int count, std::uint32_t seed) {
    LUXEL_ASSERT(count >= 0, "count={}", count);
    const Bounds bounds = scene.bounds();
    std::vector<Camera> views;
    for (std::uint32_t attempt = 0; int(views.size()) < count; ++attempt) {
        if (attempt >= std::uint32_t(tries_per_view) * std::uint32_t(count))
            fail(Fault::bad_input,
                 "{}: views: only {} of {} views from inside were found; give cameras in the scene instead",
                 scene.name, views.size(), count);
        Camera camera = random_camera(bounds, seed, attempt);
        if (!is_valid(scene, rays, camera, bounds.radius())) continue;
        camera.name = fmt::format("seed {} view {}", seed, views.size() + 1);
        camera.near = 5e-4f * bounds.radius();
        camera.far = 4.0f * bounds.radius();
        views.push_back(camera);
    }
    return views;
}

} // namespace luxel
