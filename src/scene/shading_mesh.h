// SPDX-License-Identifier: MIT
// What surface_at() needs of a triangle, side by side in memory and in world space. Through the mesh's own
// arrays each hit would wait for an index first, then for three vertices in each of several arrays, on a page
// of memory each.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "scene/scene.h"

namespace luxel {

struct ShadingTriangle {
    glm::vec3 positions[3];
    glm::vec3
        normals[3]; // by the inverse transpose, not normalized, so that interpolation is that of object space
    glm::vec2 texcoords[3]; // set 0; 0 where the mesh has none
};
using ShadingTangents =
    std::array<glm::vec4, 3>; // w: handedness of the bitangent, a mirroring transform included

struct ShadingMesh {
    std::vector<ShadingTriangle> triangles;
    std::vector<ShadingTangents> tangents; // empty where the material has no normal map
};

ShadingTriangle shading_triangle(const Scene& scene, std::uint32_t instance, std::uint32_t triangle);
ShadingTangents shading_tangents(const Scene& scene, std::uint32_t instance, std::uint32_t triangle);
ShadingMesh shading_mesh(const Scene& scene, std::uint32_t instance);

// Asks for what surface_at() reads of a triangle.
inline void prefetch(const ShadingMesh& mesh, std::uint32_t triangle) {
    const char* start = reinterpret_cast<const char*>(&mesh.triangles[triangle]);
    __builtin_prefetch(start), __builtin_prefetch(start + sizeof(ShadingTriangle) - 1);
    if (!mesh.tangents.empty()) __builtin_prefetch(&mesh.tangents[triangle]);
}

// The one way a position gets to world space: equal inputs give equal bits everywhere.
inline glm::vec3 transform_point(const glm::mat4& m, glm::vec3 p) {
    return glm::vec3(m[0]) * p.x + glm::vec3(m[1]) * p.y + glm::vec3(m[2]) * p.z + glm::vec3(m[3]);
}

} // namespace luxel
