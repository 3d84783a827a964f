// SPDX-License-Identifier: MIT
// Test only: the walls of the box [-1, 1]^3 as quads, and their irradiance by an independent formula.
#pragma once
#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "shared/cube.h"
#include "shared/form_factor.h"

namespace luxel::testing {

// By face, in the order of shared/cube.h.
inline constexpr double wall_radiance[6] = {1.0, 0.2, 3.0, 0.5, 2.0, 0.1};

// Texel (i, j) of m x m of a wall, from a receiver, in the order in which it sends inward.
inline shared::Quad wall_quad(int face, int m, int i, int j, glm::vec3 receiver) {
    auto corner = [&](int x, int y) {
        return shared::cube_direction(face, glm::vec2(x, y) / float(m)) - receiver;
    };
    return {corner(i, j), corner(i, j + 1), corner(i + 1, j + 1), corner(i + 1, j)};
}

struct BoxReceiver {
    glm::vec3 position, normal;
};
inline BoxReceiver random_receiver(std::mt19937& random) {
    std::uniform_real_distribution<float> inside(-0.98f, 0.98f);
    std::normal_distribution<float> axis;
    glm::vec3 position(inside(random), inside(random), inside(random));
    return {position, glm::normalize(glm::vec3(axis(random), axis(random), axis(random)))};
}

// Sutherland and Hodgman's clipping, then Lambert's sum over the edges of angle times cosine, all in double
// precision [Lambert1760]. Positive for the winding of wall_quad.
inline double lambert_signed(const std::vector<glm::vec3>& polygon, glm::vec3 normal) {
    const glm::dvec3 n = glm::normalize(glm::dvec3(normal));
    std::vector<glm::dvec3> above;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec3 a(polygon[i]), b(polygon[(i + 1) % polygon.size()]);
        const double ha = glm::dot(a, n), hb = glm::dot(b, n);
        if (ha >= 0) above.push_back(a);
        if ((ha >= 0) != (hb >= 0)) above.push_back(a + (b - a) * (ha / (ha - hb)));
    }
    double sum = 0;
    for (std::size_t i = 0; i < above.size(); ++i) {
        const glm::dvec3 a = glm::normalize(above[i]), b = glm::normalize(above[(i + 1) % above.size()]);
        const glm::dvec3 c = glm::cross(a, b);
        if (glm::length(c) < 1e-14) continue;
        sum += std::acos(std::clamp(glm::dot(a, b), -1.0, 1.0)) * glm::dot(glm::normalize(c), n) / 2;
    }
    return sum;
}
inline double lambert_irradiance(const shared::Quad& q, glm::vec3 normal) {
    return std::max(lambert_signed({q.a, q.b, q.c, q.d}, normal), 0.0);
}

// The wall that a ray from inside the box meets.
inline int wall_met(glm::vec3 from, glm::vec3 direction) {
    int face = 0;
    float nearest = 1e30f;
    for (int i = 0; i < 3; ++i) {
        float t = ((direction[i] > 0 ? 1.0f : -1.0f) - from[i]) / direction[i];
        if (t < nearest) nearest = t, face = 2 * i + (direction[i] > 0 ? 0 : 1);
    }
    return face;
}

} // namespace luxel::testing
