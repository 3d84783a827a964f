// SPDX-License-Identifier: MIT
#include "scene/shading_mesh.h"

namespace luxel {
namespace {

const Mesh& mesh_of(const Scene& scene, std::uint32_t instance) {
    return scene.meshes[std::size_t(scene.instances[instance].mesh)];
}

// Columns are cross products of the transform's: the inverse transpose up to a positive factor.
glm::mat3 normal_matrix(const glm::mat4& transform) {
    glm::vec3 x(transform[0]), y(transform[1]), z(transform[2]);
    return glm::mat3(glm::cross(y, z), glm::cross(z, x), glm::cross(x, y)) * handedness(transform);
}

} // namespace

ShadingTriangle shading_triangle(const Scene& scene, std::uint32_t instance, std::uint32_t triangle) {
    const Mesh& mesh = mesh_of(scene, instance);
    const glm::mat4& transform = scene.instances[instance].transform;
    const glm::mat3 to_normal = normal_matrix(transform);
    ShadingTriangle t;
    for (std::size_t k = 0; k < 3; ++k) {
        std::uint32_t i = mesh.indices[std::size_t(triangle) * 3 + k];
        t.positions[k] = transform_point(transform, mesh.positions[i]);
        t.normals[k] = to_normal * mesh.normals[i];
        t.texcoords[k] = mesh.texcoords[0].empty() ? glm::vec2(0.0f) : mesh.texcoords[0][i];
    }
    return t;
}

ShadingTangents shading_tangents(const Scene& scene, std::uint32_t instance, std::uint32_t triangle) {
    const Mesh& mesh = mesh_of(scene, instance);
    const glm::mat4& transform = scene.instances[instance].transform;
    ShadingTangents tangents;
    for (std::size_t k = 0; k < 3; ++k) {
        glm::vec4 t = mesh.tangents[mesh.indices[std::size_t(triangle) * 3 + k]];
        tangents[k] = glm::vec4(glm::mat3(transform) * glm::vec3(t), t.w * handedness(transform));
    }
    return tangents;
}

ShadingMesh shading_mesh(const Scene& scene, std::uint32_t instance) {
    const Mesh& mesh = mesh_of(scene, instance);
    const std::size_t count = mesh.indices.size() / 3;
    const Material& material = scene.materials[std::size_t(mesh.material)];
    const bool bumpy = material.normal_texture.texture >= 0 && !mesh.tangents.empty();
    ShadingMesh result;
    result.triangles.reserve(count);
    if (bumpy) result.tangents.reserve(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        result.triangles.push_back(shading_triangle(scene, instance, i));
        if (bumpy) result.tangents.push_back(shading_tangents(scene, instance, i));
    }
    return result;
}

} // namespace luxel
