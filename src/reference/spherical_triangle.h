// SPDX-License-Identifier: MIT
// Triangles as a point sees them: their solid angle, and directions uniform in it [Arvo1995].
#pragma once
#include <glm/glm.hpp>

namespace luxel {

struct SphericalTriangle {
    // None where the point lies in the triangle's plane or on a corner: solid_angle is 0.
    SphericalTriangle(glm::vec3 from, glm::vec3 a, glm::vec3 b, glm::vec3 c);
    glm::vec3 sample(glm::vec2 u) const; // unit

    glm::vec3 a, b, c; // unit, from the point
    float solid_angle = 0.0f;
};

} // namespace luxel
