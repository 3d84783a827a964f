// SPDX-License-Identifier: MIT
#include "techniques/frame/frustum.h"

namespace luxel {
namespace {

float distance_to(glm::vec4 plane, glm::vec3 p) { return glm::dot(glm::vec3(plane), p) + plane.w; }

// The part of a convex polygon on a plane's inner side (Sutherland and Hodgman).
std::vector<glm::vec3> clip(const std::vector<glm::vec3>& polygon, glm::vec4 plane) {
    std::vector<glm::vec3> inside;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        glm::vec3 a = polygon[i], b = polygon[(i + 1) % polygon.size()];
        float da = distance_to(plane, a), db = distance_to(plane, b);
        if (da >= 0.0f) inside.push_back(a);
        if ((da >= 0.0f) != (db >= 0.0f)) inside.push_back(a + (b - a) * (da / (da - db)));
    }
    return inside;
}

} // namespace

Frustum frustum_of(const glm::mat4& m) {
    glm::mat4 rows = glm::transpose(m);
    return {rows[3] + rows[0], rows[3] - rows[0], rows[3] + rows[1],
            rows[3] - rows[1], rows[2],           rows[3] - rows[2]};
}

bool touches(const Frustum& frustum, const Bounds& bounds) {
    if (bounds.empty()) return false;
    for (glm::vec4 plane : frustum) {
        // The corner farthest along the plane's normal.
        glm::vec3 corner =
            glm::mix(bounds.least, bounds.most, glm::greaterThan(glm::vec3(plane), glm::vec3(0.0f)));
        if (distance_to(plane, corner) < 0.0f) return false;
    }
    return true;
}

std::vector<glm::vec3> common_corners(const Bounds& box, const Frustum& frustum, glm::vec3 apex) {
    std::vector<glm::vec3> corners;
    if (box.empty()) return corners;

    // Every vertex of the common volume but the apex lies on a side of the box.
    glm::vec3 ends[2] = {box.least, box.most};
    for (int axis = 0; axis < 3; ++axis) {
        for (glm::vec3 end : ends) {
            int u = (axis + 1) % 3, v = (axis + 2) % 3;
            std::vector<glm::vec3> side(4, end);
            side[0][u] = side[3][u] = box.least[u], side[1][u] = side[2][u] = box.most[u];
            side[0][v] = side[1][v] = box.least[v], side[2][v] = side[3][v] = box.most[v];
            for (glm::vec4 plane : frustum) side = clip(side, plane);
            corners.insert(corners.end(), side.begin(), side.end());
        }
    }
    if (glm::all(glm::lessThanEqual(box.least, apex)) && glm::all(glm::lessThanEqual(apex, box.most)))
        corners.push_back(apex);
    return corners;
}

} // namespace luxel
