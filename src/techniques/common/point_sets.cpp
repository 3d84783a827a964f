// SPDX-License-Identifier: MIT
#include "techniques/common/point_sets.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include "core/error.h"
#include "shared/sampling.h"

namespace luxel {
namespace {

using Points = std::vector<glm::vec3>;

// Element i of the additive recurrence of the unit cube whose base is the root of x^4 = x + 1 [Roberts2018].
glm::vec3 recurrence(int i) {
    return glm::fract(glm::vec3(0.5f) + float(i + 1) * glm::vec3(0.8191725f, 0.6710436f, 0.5497005f));
}

// Candidates per point: the number that [Yuksel2015, 4] recommends.
constexpr int candidates_per_point = 5;

// Gives the points the values f(0), f(1), ..., in the order of key(point): the density along the key becomes
// uniform, and neighbors stay neighbors.
void equalize(Points& points, const std::function<float(glm::vec3)>& key,
              const std::function<void(glm::vec3&, float)>& assign) {
    std::vector<std::size_t> order(points.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return key(points[a]) < key(points[b]); });
    for (std::size_t i = 0; i < order.size(); ++i)
        assign(points[order[i]], (float(i) + 0.5f) / float(points.size()));
}

float disc_radius(glm::vec3 p) { return glm::length(glm::vec2(p)); }
void set_disc_radius(glm::vec3& p, float share) {
    float scale = std::sqrt(share) / std::max(disc_radius(p), 1e-6f);
    p.x *= scale, p.y *= scale;
}

} // namespace

std::vector<glm::vec3> eliminate_samples(Points points, int n, int dimensions, float measure) {
    LUXEL_ASSERT(n >= 1 && points.size() >= std::size_t(n), "n={} of {}", n, points.size());
    LUXEL_ASSERT(dimensions == 2 || dimensions == 3, "dimensions={}", dimensions);

    // The largest radius that n discs or balls of a densest packing can have [Yuksel2015, eq. 2 and 3].
    double share = double(measure) / double(n);
    double reach = 2.0 * (dimensions == 2 ? std::sqrt(share / (2.0 * std::sqrt(3.0)))
                                          : std::cbrt(share / (4.0 * std::sqrt(2.0))));
    // Weight of a neighbor; alpha = 8 [Yuksel2015, eq. 4].
    auto weight = [&](glm::vec3 a, glm::vec3 b) {
        double d = std::min(double(glm::distance(a, b)), reach);
        return std::pow(1.0 - d / reach, 8.0);
    };
    std::vector<double> weights(points.size(), 0.0);
    for (std::size_t i = 0; i < points.size(); ++i)
        for (std::size_t j = 0; j < points.size(); ++j)
            if (j != i) weights[i] += weight(points[i], points[j]);

    // The most crowded point goes, and its neighbors are the less crowded for it.
    while (points.size() > std::size_t(n)) {
        auto most = std::ptrdiff_t(std::max_element(weights.begin(), weights.end()) - weights.begin());
        glm::vec3 gone = points[std::size_t(most)];
        points.erase(points.begin() + most);
        weights.erase(weights.begin() + most);
        for (std::size_t i = 0; i < points.size(); ++i) weights[i] -= weight(points[i], gone);
    }
    return points;
}

std::vector<glm::vec3> poisson_disc(int n) {
    Points points;
    for (int i = 0; i < n * candidates_per_point; ++i) {
        glm::vec3 u = recurrence(i);
        points.emplace_back(shared::sample_disc({u.x, u.y}), 0.0f);
    }
    points = eliminate_samples(std::move(points), n, 2, shared::PI);
    equalize(points, disc_radius, set_disc_radius);
    return points;
}

std::vector<glm::vec3> poisson_cylinder(int n) {
    Points points;
    for (int i = 0; i < n * candidates_per_point; ++i) {
        glm::vec3 u = recurrence(i);
        points.emplace_back(shared::sample_disc({u.x, u.y}), u.z);
    }
    points = eliminate_samples(std::move(points), n, 3, shared::PI);
    equalize(points, disc_radius, set_disc_radius);
    equalize(
        points, [](glm::vec3 p) { return p.z; }, [](glm::vec3& p, float share) { p.z = share; });
    return points;
}

std::vector<glm::vec3> poisson_ball(int n) {
    Points points;
    for (int i = 0; i < n * candidates_per_point; ++i) {
        glm::vec3 u = recurrence(i);
        points.push_back(shared::sample_sphere({u.x, u.y}) * std::cbrt(u.z));
    }
    points = eliminate_samples(std::move(points), n, 3, 4.0f / 3.0f * shared::PI);
    equalize(
        points, [](glm::vec3 p) { return glm::length(p); },
        [](glm::vec3& p, float share) { p *= std::cbrt(share) / std::max(glm::length(p), 1e-6f); });
    return points;
}

} // namespace luxel
