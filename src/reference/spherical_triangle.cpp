// SPDX-License-Identifier: MIT
#include "reference/spherical_triangle.h"

#include <algorithm>
#include <cmath>

namespace luxel {
namespace {

// Unit vector across `axis` in the plane of both; `axis` itself where they are parallel.
glm::dvec3 across(glm::dvec3 axis, glm::dvec3 v) {
    const glm::dvec3 aside = v - axis * glm::dot(axis, v);
    const double length = glm::length(aside);
    return length > 0.0 ? aside / length : axis;
}

// The angle between the arcs to b and to c at a.
double corner(glm::dvec3 a, glm::dvec3 b, glm::dvec3 c) {
    return std::acos(glm::clamp(glm::dot(across(a, b), across(a, c)), -1.0, 1.0));
}

} // namespace

SphericalTriangle::SphericalTriangle(glm::vec3 from, glm::vec3 p, glm::vec3 q, glm::vec3 r)
    : a(p - from), b(q - from), c(r - from) {
    const float la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
    if (!(la > 0.0f && lb > 0.0f && lc > 0.0f)) return;
    // [VanOosterom1983, eq. 8]; the triple product by edges, which cancels less where the triangle is far.
    const float triple = std::abs(glm::dot(a, glm::cross(q - p, r - p)));
    const float below = la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb;
    solid_angle = 2.0f * std::atan2(triple, below);
    a /= la, b /= lb, c /= lc;
}

// Double precision: the angles of small triangles are differences of large ones.
glm::vec3 SphericalTriangle::sample(glm::vec2 u) const {
    const glm::dvec3 A = glm::normalize(glm::dvec3(a)), B = glm::normalize(glm::dvec3(b)),
                     C = glm::normalize(glm::dvec3(c));
    const double alpha = corner(A, B, C), beta = corner(B, C, A), gamma = corner(C, A, B);
    const double whole = alpha + beta + gamma - 3.14159265358979323846;

    // The triangle A B C' whose area is the share u.x has its corner C' on the arc A C.
    const double phi = double(u.x) * whole - alpha, s = std::sin(phi), t = std::cos(phi);
    const double sin_a = std::sin(alpha), cos_a = std::cos(alpha);
    const double x = t - cos_a, y = s + sin_a * glm::dot(A, B);
    const double divisor = (y * s + x * t) * sin_a;
    const double q = divisor != 0.0 ? glm::clamp(((y * t - x * s) * cos_a - y) / divisor, -1.0, 1.0) : 1.0;
    const glm::dvec3 moved = A * q + across(A, C) * std::sqrt(std::max(1.0 - q * q, 0.0));

    // On the arc from B to it, uniform in height.
    const double z = 1.0 - double(u.y) * (1.0 - glm::dot(moved, B));
    return glm::vec3(B * z + across(B, moved) * std::sqrt(std::max(1.0 - z * z, 0.0)));
}

} // namespace luxel
