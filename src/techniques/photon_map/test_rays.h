// SPDX-License-Identifier: MIT
// Rays that leave specular surfaces, traced on the CPU, and how well the lists find their ends.
#pragma once
#include <string>
#include <vector>

#include <fmt/format.h>

#include "scene/raycast.h"
#include "scene/surface.h"
#include "shared/random.h"
#include "shared/sampling.h"
#include "techniques/photon_map/photon_map.h"

namespace luxel {

struct TestRay {
    glm::vec3 origin, direction;
    bool inside;
    float t;          // by ray casting; < 0: nothing met
    glm::vec3 normal; // there, unit
};

// From the scene's first light to random points of specular surfaces, and one reflection or refraction
// further.
inline std::vector<TestRay> specular_rays(const Scene& scene, int count) {
    const RayCaster rays(scene);
    const Bounds box = scene.bounds();
    std::vector<TestRay> found;
    for (shared::uint i = 0; int(found.size()) < count && i < 400u * shared::uint(count); ++i) {
        const auto random = [&](shared::uint k) { return shared::uniform_float(shared::hash2(i, k)); };
        const glm::vec3 to = glm::mix(box.least, box.most, glm::vec3(random(1), random(2), random(3)));
        Ray ray{scene.lights[0].position, glm::normalize(to - scene.lights[0].position)};
        Hit hit;
        if (!rays.intersect(ray, hit)) continue;
        const Surface s = surface_at(scene, hit, ray.direction);
        const bool glass = s.transmission > 0.5f;
        if (!glass && s.metallic < 0.5f) continue;
        const glm::vec3 out = glass ? glm::refract(ray.direction, s.normal, 1.0f / s.material->ior)
                                    : glm::reflect(ray.direction, s.normal);
        const float side = glm::dot(out, s.geometric_normal) > 0.0f ? 1.0f : -1.0f;
        TestRay r{s.position + s.geometric_normal * (s.offset * side), glm::normalize(out), glass, -1.0f, {}};
        if (rays.intersect({r.origin, r.direction}, hit)) {
            r.t = hit.t;
            r.normal = glm::normalize(hit.geometric_normal);
        }
        found.push_back(r);
    }
    return found;
}

inline PhotonBuffers upload_rays(gpu::Gpu& gpu, const std::vector<TestRay>& rays, glm::vec3 center) {
    std::vector<shared::Photon> photons;
    for (const TestRay& r : rays)
        photons.push_back({.position = r.origin - center,
                           .state = shared::PHOTON_FLYING,
                           .direction = r.direction,
                           .inside = r.inside ? 1u : 0u,
                           .power = glm::vec3(1.0f),
                           .travelled = 0.0f,
                           .beam = 0.0f,
                           .parallel = 1u,
                           .key = 0u});
    std::vector<shared::uint> counts(shared::PHOTON_LEVELS + shared::PHOTON_MAX_LEVELS, 0u);
    counts[shared::PHOTON_COUNT] = shared::uint(rays.size());
    const std::vector<shared::PhotonHit> none(rays.size(), shared::PhotonHit{0.0f, -2, 0, 0});
    return {.photons = gpu.upload(std::span<const shared::Photon>(photons), "photons"),
            .hits = gpu.upload(std::span<const shared::PhotonHit>(none), "photon hits"),
            .counts = gpu.upload(std::span<const shared::uint>(counts), "photon counts"),
            .most = int(rays.size())};
}

// Rays that count: their ends lie in the view and are not edge-on.
struct TraceResult {
    int counted = 0, right = 0;
    int passed = 0, missed = 0;   // ended farther; met nothing
    int early = 0;                // ended nearer
    int outside = 0, edge_on = 0; // not counted
    double cells = 0, nodes = 0;  // visited, a ray
    std::vector<float> t;
};

inline std::string describe(const TraceResult& r) {
    const double n = std::max(r.counted, 1) / 100.0;
    return fmt::format("{} rays: right {:.2f} %, farther {:.2f} %, nothing {:.2f} %, nearer {:.2f} %; {} "
                       "outside, {} edge-on; "
                       "{:.1f} cells, {:.1f} nodes",
                       r.counted, r.right / n, r.passed / n, r.missed / n, r.early / n, r.outside, r.edge_on,
                       r.cells, r.nodes);
}

inline TraceResult compare_hits(gpu::Gpu& gpu, const FragmentLists& lists, const PhotonBuffers& photons,
                                const std::vector<TestRay>& rays) {
    const auto hits = gpu.read_all<shared::PhotonHit>(photons.hits);
    const shared::ListView& v = lists.view();
    TraceResult result;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const TestRay& ray = rays[i];
        result.t.push_back(hits[i].t);
        result.cells += double(hits[i].cells) / double(rays.size());
        result.nodes += double(hits[i].nodes) / double(rays.size());
        if (ray.t < 0.0f) continue;
        const glm::vec3 end = ray.origin + ray.direction * ray.t - v.center;
        const glm::vec4 at = v.to_pixel * glm::vec4(end, 1.0f);
        const glm::vec2 pixel = glm::vec2(at) / at.w;
        const bool seen =
            at.z > v.near && std::min(pixel.x, pixel.y) > 0.0f && std::max(pixel.x, pixel.y) < float(v.side);
        if (!seen) {
            ++result.outside;
            continue;
        }
        // The view goes where pixel coordinates stay as they are.
        const glm::mat4 rows = glm::transpose(v.to_pixel);
        const glm::vec3 view = glm::normalize(
            glm::cross(glm::vec3(rows[0] - pixel.x * rows[3]), glm::vec3(rows[1] - pixel.y * rows[3])));
        if (std::abs(glm::dot(view, ray.normal)) <= 0.1f) {
            ++result.edge_on;
            continue;
        }
        ++result.counted;
        const float reach = 2.0f * v.pixel * at.w;
        if (hits[i].node < 0)
            ++result.missed;
        else if (std::abs(hits[i].t - ray.t) <= reach)
            ++result.right;
        else if (hits[i].t > ray.t)
            ++result.passed;
        else
            ++result.early;
    }
    return result;
}

} // namespace luxel
