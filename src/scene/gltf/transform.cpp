// SPDX-License-Identifier: MIT
#include "scene/gltf/transform.h"

#include <algorithm>
#include <cmath>

#include <glm/gtc/quaternion.hpp>

namespace luxel::gltf {
namespace {

// Thickness of what is flattened, relative to its extent: more than single precision loses, less than one
// sees.
constexpr double thinnest = 1e-6;

double sign_of(double v) { return v < 0.0 ? -1.0 : 1.0; }

double length_of(const glm::dmat3& m) {
    return std::sqrt(glm::dot(m[0], m[0]) + glm::dot(m[1], m[1]) + glm::dot(m[2], m[2]));
}

} // namespace

Place trs(const glm::dvec3& translation, const glm::dvec4& r, const glm::dvec3& scale) {
    const glm::dmat3 rotation = glm::mat3_cast(glm::normalize(glm::dquat(r.w, r.x, r.y, r.z)));
    return {glm::dmat4(glm::dvec4(rotation[0] * scale.x, 0.0), glm::dvec4(rotation[1] * scale.y, 0.0),
                       glm::dvec4(rotation[2] * scale.z, 0.0), glm::dvec4(translation, 1.0)),
            sign_of(scale.x) * sign_of(scale.y) * sign_of(scale.z)};
}

Place local_place(const Value& node) {
    if (const Value matrix = node["matrix"]) {
        glm::dmat4 m;
        matrix.numbers(std::span<double>(&m[0][0], 16));
        const glm::dvec4 last_row(m[0][3], m[1][3], m[2][3], m[3][3] - 1.0);
        if (glm::length(last_row) > 1e-4) matrix.fail("is not affine");
        m[0][3] = m[1][3] = m[2][3] = 0.0, m[3][3] = 1.0;
        return {m, sign_of(glm::determinant(glm::dmat3(m)))};
    }
    const glm::dvec4 rotation = node["rotation"].dvec<4>(glm::dvec4(0, 0, 0, 1));
    if (!(glm::length(rotation) > 1e-6)) node["rotation"].fail("is no rotation");
    return trs(node["translation"].dvec<3>(glm::dvec3(0.0)), rotation,
               node["scale"].dvec<3>(glm::dvec3(1.0)));
}

glm::dmat3 cofactors(const glm::dmat3& m) {
    return {glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1])};
}

std::optional<glm::dmat4> solid_transform(const Place& place) {
    const glm::dmat3 linear(place.transform);
    const double length = length_of(linear);
    if (!(length > 0.0) || !std::isfinite(length)) return std::nullopt;

    // The cofactors of a flattening matrix are the outer product of the normal of the plane it flattens to
    // and the direction that vanishes: what is missing, up to its length and side.
    const glm::dmat3 unit = linear * (1.0 / length), cofactor = cofactors(unit);
    const double area = length_of(cofactor);
    if (!(area > 1e-12)) return std::nullopt;
    const double depth = std::abs(glm::determinant(unit)) / area;
    if (depth >= thinnest) return place.transform;
    glm::dmat4 solid = place.transform;
    for (int c = 0; c < 3; ++c)
        for (int r = 0; r < 3; ++r)
            solid[c][r] += cofactor[c][r] / area * place.side * (thinnest - depth) * length;
    return solid;
}

} // namespace luxel::gltf
