// SPDX-License-Identifier: MIT
// Area lights as one-sided cosine emitters: found in the meshes, then sampled by power.
#include "scene/lights.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "scene/emission_map.h"
#include "scene/emission_mean.h"
#include "scene/surface.h"
#include "shared/random.h"
#include "shared/sampling.h"

namespace luxel {
namespace {

using shared::Light;

void append_instance(const Scene& scene, std::uint32_t index, EmissionMeans& means,
                     std::vector<EmissiveTriangle>& found) {
    const Instance& instance = scene.instances[index];
    const Mesh& mesh = scene.meshes[std::size_t(instance.mesh)];
    const Material& material = scene.materials[std::size_t(mesh.material)];
    if (luminance(material.emission) <= 0.0f) return;

    const float winding = handedness(instance.transform);
    for (std::uint32_t t = 0; t < mesh.indices.size() / 3; ++t) {
        const std::uint32_t* k = &mesh.indices[std::size_t(t) * 3];
        EmissiveTriangle e{};
        e.a = transform_point(instance.transform, mesh.positions[k[0]]);
        e.b = transform_point(instance.transform, mesh.positions[k[1]]);
        e.c = transform_point(instance.transform, mesh.positions[k[2]]);

        // Without area or light it would only be a hole in the distributions built from this list.
        const glm::vec3 cross = glm::cross(e.b - e.a, e.c - e.a);
        const float length = glm::length(cross);
        if (!(length > 0.0f)) continue;
        e.emission = means.mean(index, t);
        if (luminance(e.emission) <= 0.0f) continue;

        e.normal = cross * (winding / length);
        e.area = length * 0.5f;
        e.two_sided = material.double_sided;
        e.instance = int(index);
        e.triangle = t;
        found.push_back(e);
    }
}

// Uniform in area, and neighbors in the square stay neighbors [Heitz2019].
glm::vec2 square_to_triangle(glm::vec2 u) {
    if (u.y > u.x) {
        u.x *= 0.5f;
        u.y -= u.x;
    } else {
        u.y *= 0.5f;
        u.x -= u.y;
    }
    return u;
}

// Where a light stands, and its color: points by brightness, whose colors have the mean of the triangle when
// all are equally bright. Points that a mask cuts out are drawn again.
struct Sampled {
    glm::vec2 uv;
    glm::vec3 color;
};
Sampled sample_of(const Scene& scene, const EmissiveTriangle& e, const EmissionMap& map, glm::vec2 u) {
    constexpr int most_draws = 64;
    const std::uint32_t instance = std::uint32_t(e.instance);
    for (int i = 0; i < most_draws; ++i) {
        const glm::vec2 uv = map.varies() ? map.draw(u).uv : square_to_triangle(u);
        const glm::vec3 color = map.varies() ? emission_at(scene, instance, e.triangle, uv) : e.emission;
        if (luminance(color) > 0.0f && !is_transparent(scene, instance, e.triangle, uv)) return {uv, color};
        u = glm::fract(u + glm::vec2(0.7548776662f, 0.5698402910f)); // the next of a low-discrepancy sequence
    }
    return {square_to_triangle(u), e.emission};
}

float side_power(const EmissiveTriangle& e) { return luminance(e.emission) * e.area; }

// The samples of one side of one triangle: a low-discrepancy set of their own, shifted by the seed.
void append_side(const Scene& scene, const EmissiveTriangle& e, float side, int count, float luminance_each,
                 float lift, std::uint32_t seed, std::vector<Light>& lights) {
    if (count == 0) return;
    const EmissionMap map(scene, std::uint32_t(e.instance), e.triangle);
    const glm::vec2 shift(
        shared::uniform_float(shared::hash3(seed, e.triangle, std::uint32_t(e.instance) * 2u)),
        shared::uniform_float(shared::hash3(seed, e.triangle, std::uint32_t(e.instance) * 2u + 1u)));
    for (int i = 0; i < count; ++i) {
        const glm::vec2 u = glm::fract(shared::hammersley(std::uint32_t(i), std::uint32_t(count)) + shift);
        const Sampled s = sample_of(scene, e, map, u);
        Light light{};
        light.type = shared::LIGHT_COSINE;
        light.direction = e.normal * side;
        light.position = e.a + (e.b - e.a) * s.uv.x + (e.c - e.a) * s.uv.y + light.direction * lift;
        light.intensity = s.color * (luminance_each / luminance(s.color));
        light.extent = e.area / float(count);
        lights.push_back(light);
    }
}

} // namespace

std::vector<EmissiveTriangle> emissive_triangles(const Scene& scene) {
    std::vector<EmissiveTriangle> found;
    EmissionMeans means(scene);
    for (std::uint32_t i = 0; i < scene.instances.size(); ++i) append_instance(scene, i, means, found);
    return found;
}

std::vector<Light> emitter_sample_lights(const Scene& scene, int count, std::uint32_t seed) {
    LUXEL_ASSERT(count > 0, "count={}", count);
    const std::vector<EmissiveTriangle> emitters = emissive_triangles(scene);
    double total = 0.0;
    for (const EmissiveTriangle& e : emitters) total += double(side_power(e)) * (e.two_sided ? 2.0 : 1.0);
    std::vector<Light> lights;
    if (!(total > 0.0)) return lights;
    lights.reserve(std::size_t(count));

    // Systematic sampling of the power CDF: sample i lies at (i + offset) / count, so a side that holds the
    // share p of the power gets count x p samples to within one. Each carries the power total / count.
    const double offset = double(shared::uniform_float(shared::hash2(seed, 0x6c696768u)));
    const float lift = 1e-4f * scene.bounds().radius();
    double below = 0.0;
    const auto samples_below = [&](double power) {
        return std::clamp(int(std::ceil(power / total * count - offset)), 0, count);
    };
    for (std::size_t i = 0; i < emitters.size(); ++i) {
        const EmissiveTriangle& e = emitters[i];
        const float each = float(total / count);
        for (const float side : {1.0f, -1.0f}) {
            if (side < 0.0f && !e.two_sided) continue;
            const bool last = i + 1 == emitters.size() && (side < 0.0f || !e.two_sided);
            const double above = below + double(side_power(e));
            const int first = samples_below(below), end = last ? count : samples_below(above);
            append_side(scene, e, side, end - first, each, lift, seed, lights);
            below = above;
        }
    }
    return lights;
}

} // namespace luxel
