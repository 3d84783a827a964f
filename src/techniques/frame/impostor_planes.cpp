// SPDX-License-Identifier: MIT
// Greedy choice in plane space: the plane on which the triangles that it may stand for cast the largest area
// comes first, they are taken away, and so on [Decoret2003, 3]. Two deviations: planes are tried as they
// stand instead of being refined by subdivision, with the planes of the largest triangles left among them,
// and there is no penalty for planes that just miss a triangle.
#include "techniques/frame/impostor_planes.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/parallel.h"
#include "shared/glsl.h"

namespace luxel {
namespace {

// A bound on time and memory; each further normal is one more to choose from, no plane depends on it.
constexpr int most_normals = 1024;
constexpr double least_sine = 1e-8; // of a triangle's angles; below it is a line, which no view shows
constexpr float least_share = 0.5f; // of a triangle's area on its plane

struct Triangle {
    glm::vec3 corner[3]; // relative to the object's center
    glm::vec3 normal;    // unit
    float area;          // square meters
};

bool is_within(const Triangle& t, glm::vec3 normal, float offset, float distance) {
    for (glm::vec3 p : t.corner)
        if (!(std::abs(glm::dot(normal, p) - offset) <= distance)) return false;
    return true;
}

// Areas that triangles cast on planes of given normals at equal steps of the offset.
class PlaneSpace {
public:
    PlaneSpace(float radius, float distance) : distance_(distance), least_(-radius), step_(distance * 0.5f) {
        // Neighbors differ by the angle that moves a plane of the object's size by the distance.
        const float wanted = 2.0f * shared::PI * (radius / distance) * (radius / distance);
        const int count = int(std::clamp(wanted, 16.0f, float(most_normals)));
        const float turn = shared::PI * (3.0f - std::sqrt(5.0f));
        for (int i = 0; i < count; ++i) {
            const float z = (float(i) + 0.5f) / float(count), r = std::sqrt(1.0f - z * z);
            normals_.push_back({r * std::cos(turn * float(i)), r * std::sin(turn * float(i)), z});
        }
        steps_ = std::min(int(2.0f * radius / step_), most_steps - 1) + 1;
        step_ = std::max(step_, 2.0f * radius / float(steps_));
        rise_.resize(normals_.size() * std::size_t(steps_ + 1));
    }

    // sign: 1 adds, -1 takes away.
    void add(const std::vector<Triangle>& triangles, const std::vector<std::uint32_t>& chosen, float sign) {
        parallel_for(normals_.size(), 16, [&](std::size_t i) {
            for (std::uint32_t index : chosen) {
                const Triangle& t = triangles[index];
                const float share = std::abs(glm::dot(normals_[i], t.normal));
                if (share < least_share) continue;
                const float a = glm::dot(normals_[i], t.corner[0]), b = glm::dot(normals_[i], t.corner[1]),
                            c = glm::dot(normals_[i], t.corner[2]);
                const float first = std::ceil((std::max({a, b, c}) - distance_ - least_) / step_);
                const float last = std::floor((std::min({a, b, c}) + distance_ - least_) / step_);
                if (first > last || last < 0.0f || first >= float(steps_)) continue;
                const double cast = double(sign * t.area * share);
                double* rise = &rise_[i * std::size_t(steps_ + 1)];
                rise[int(std::max(first, 0.0f))] += cast;
                rise[std::min(int(last) + 1, steps_)] -= cast;
            }
        });
    }

    // The plane with the largest area.
    std::pair<glm::vec3, float> best() const {
        double largest = -1.0;
        std::pair<glm::vec3, float> plane{normals_[0], 0.0f};
        for (std::size_t i = 0; i < normals_.size(); ++i) {
            double area = 0.0;
            for (int j = 0; j < steps_; ++j) {
                area += rise_[i * std::size_t(steps_ + 1) + std::size_t(j)];
                if (area > largest) largest = area, plane = {normals_[i], least_ + step_ * float(j)};
            }
        }
        return plane;
    }

private:
    static constexpr int most_steps = 4096;
    float distance_, least_, step_;
    int steps_ = 0;
    std::vector<glm::vec3> normals_;
    std::vector<double> rise_; // for each normal: how the area changes from one offset to the next
};

struct Covered {
    std::vector<std::uint32_t> triangles;
    double area = 0.0; // cast on the plane
};
Covered cover(const std::vector<Triangle>& triangles, const std::vector<std::uint32_t>& left,
              glm::vec3 normal, float offset, float distance) {
    Covered covered;
    for (std::uint32_t index : left) {
        const Triangle& t = triangles[index];
        const float share = std::abs(glm::dot(normal, t.normal));
        if (share < least_share || !is_within(t, normal, offset, distance)) continue;
        covered.triangles.push_back(index);
        covered.area += double(t.area * share);
    }
    return covered;
}

} // namespace

std::vector<ImpostorPlane> choose_planes(const std::vector<glm::vec3>& corners, float distance) {
    LUXEL_ASSERT(corners.size() % 3 == 0 && distance > 0.0f, "corners={} distance={}", corners.size(),
                 distance);
    glm::vec3 least(1e30f), most(-1e30f);
    for (glm::vec3 p : corners) least = glm::min(least, p), most = glm::max(most, p);
    const glm::vec3 center = (least + most) * 0.5f;

    // The largest first, as candidates for planes of their own.
    std::vector<Triangle> triangles(corners.size() / 3);
    std::vector<std::uint32_t> left;
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        Triangle& t = triangles[i];
        for (std::size_t k = 0; k < 3; ++k) t.corner[k] = corners[3 * i + k] - center;
        // In double precision: a sliver's normal would be noise, and its own plane might miss it.
        const glm::dvec3 a(t.corner[0]), u = glm::dvec3(t.corner[1]) - a, v = glm::dvec3(t.corner[2]) - a;
        const glm::dvec3 n = glm::cross(u, v);
        const double length = glm::length(n);
        t.area = float(0.5 * length);
        if (length <= least_sine * std::max(glm::dot(u, u), glm::dot(v, v))) continue;
        t.normal = glm::vec3(n / length);
        left.push_back(std::uint32_t(i));
    }
    std::stable_sort(left.begin(), left.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return triangles[a].area > triangles[b].area; });

    std::vector<ImpostorPlane> planes;
    if (left.empty()) return planes;
    PlaneSpace space(glm::length(most - least) * 0.5f, distance);
    space.add(triangles, left, 1.0f);
    while (!left.empty()) {
        auto [normal, offset] = space.best();
        Covered covered = cover(triangles, left, normal, offset, distance);
        const Triangle& largest = triangles[left[0]];
        const float own = glm::dot(largest.normal, largest.corner[0]);
        Covered of_largest = cover(triangles, left, largest.normal, own, distance);
        if (of_largest.area >= covered.area)
            normal = largest.normal, offset = own, covered = std::move(of_largest);
        LUXEL_ASSERT(!covered.triangles.empty(), "left={} offset={} distance={}", left.size(), own, distance);

        space.add(triangles, covered.triangles, -1.0f);
        std::vector<bool> gone(triangles.size());
        for (std::uint32_t index : covered.triangles) gone[index] = true;
        std::erase_if(left, [&](std::uint32_t index) { return gone[index]; });

        ImpostorPlane& plane =
            planes.emplace_back(ImpostorPlane{normal, offset + glm::dot(normal, center), {}});
        for (std::size_t i = 0; i < triangles.size(); ++i)
            if (triangles[i].area > 0.0f && is_within(triangles[i], normal, offset, distance))
                plane.triangles.push_back(std::uint32_t(i));
    }
    return planes;
}

} // namespace luxel
