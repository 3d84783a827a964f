// SPDX-License-Identifier: MIT
// Planes that stand for a mesh [Decoret2003].
#pragma once
#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

namespace luxel {

struct ImpostorPlane {
    glm::vec3 normal; // unit
    float offset;     // dot(normal, p) of its points
    // Every triangle whose corners are within the distance of the plane, ascending: also those that another
    // plane was chosen for, so that there are no cracks between planes.
    std::vector<std::uint32_t> triangles;
};

// Together the planes have every triangle that is more than a line. corners: three for each triangle.
std::vector<ImpostorPlane> choose_planes(const std::vector<glm::vec3>& corners, float distance);

} // namespace luxel
