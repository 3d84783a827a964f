// SPDX-License-Identifier: MIT
#include "scene/mesh_attributes.h"

#include <algorithm>
#include <cmath>

namespace luxel {
namespace {

// Twice the area times the unit normal, in double: products of large coordinates stay finite.
glm::dvec3 area_normal(const Mesh& mesh, std::size_t first_index) {
    const glm::dvec3 a(mesh.positions[mesh.indices[first_index]]);
    const glm::dvec3 b(mesh.positions[mesh.indices[first_index + 1]]);
    const glm::dvec3 c(mesh.positions[mesh.indices[first_index + 2]]);
    return glm::cross(b - a, c - a);
}

glm::vec3 unit_or_up(glm::dvec3 v) {
    const double length = glm::length(v);
    return length > 0.0 && std::isfinite(length) ? glm::vec3(v / length) : glm::vec3(0.0f, 1.0f, 0.0f);
}

// out[i] = in[order[i]]
template <class T> void gather(std::vector<T>& values, const std::vector<std::uint32_t>& order) {
    if (values.empty()) return;
    std::vector<T> gathered(order.size());
    for (std::size_t i = 0; i < order.size(); ++i) gathered[i] = values[order[i]];
    values = std::move(gathered);
}

void gather_vertices(Mesh& mesh, const std::vector<std::uint32_t>& order) {
    gather(mesh.positions, order);
    gather(mesh.normals, order);
    gather(mesh.tangents, order);
    for (auto& set : mesh.texcoords) gather(set, order);
    gather(mesh.colors, order);
}

// Any unit vector orthogonal to n.
glm::vec3 orthogonal(glm::vec3 n) {
    const glm::vec3 axis = std::abs(n.x) < 0.9f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
    return glm::normalize(axis - n * glm::dot(n, axis));
}

} // namespace

void make_flat(Mesh& mesh) {
    gather_vertices(mesh, mesh.indices);
    for (std::size_t i = 0; i < mesh.indices.size(); ++i) mesh.indices[i] = std::uint32_t(i);
    mesh.normals.resize(mesh.positions.size());
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
        mesh.normals[i] = mesh.normals[i + 1] = mesh.normals[i + 2] = unit_or_up(area_normal(mesh, i));
}

void repair_normals(Mesh& mesh) {
    constexpr double shortest = 1e-6;
    bool broken = false;
    for (glm::vec3& n : mesh.normals) {
        const double length = glm::length(glm::dvec3(n));
        n = length > shortest ? glm::vec3(glm::dvec3(n) / length) : glm::vec3(0.0f);
        broken = broken || !(length > shortest);
    }
    if (!broken) return;

    std::vector<glm::dvec3> sums(mesh.positions.size(), glm::dvec3(0.0));
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const glm::dvec3 n = area_normal(mesh, i);
        for (std::size_t k = 0; k < 3; ++k) sums[mesh.indices[i + k]] += n;
    }
    for (std::size_t v = 0; v < mesh.normals.size(); ++v)
        if (mesh.normals[v] == glm::vec3(0.0f)) mesh.normals[v] = unit_or_up(sums[v]);
}

void make_tangents(Mesh& mesh, int set, const glm::mat3& uv_transform) {
    // Texture axes of each face, in the plane of the face; a face weighs with its area.
    std::vector<glm::dvec3> along_u(mesh.positions.size(), glm::dvec3(0.0)), along_v = along_u;
    const auto& uvs = mesh.texcoords[set];
    for (std::size_t i = 0; !uvs.empty() && i < mesh.indices.size(); i += 3) {
        const std::uint32_t* v = &mesh.indices[i];
        const auto uv = [&](int k) { return glm::dvec2(uv_transform * glm::vec3(uvs[v[k]], 1.0f)); };
        const glm::dvec2 d1 = uv(1) - uv(0), d2 = uv(2) - uv(0);
        const glm::dvec3 e1 = glm::dvec3(mesh.positions[v[1]]) - glm::dvec3(mesh.positions[v[0]]);
        const glm::dvec3 e2 = glm::dvec3(mesh.positions[v[2]]) - glm::dvec3(mesh.positions[v[0]]);
        const double determinant = d1.x * d2.y - d2.x * d1.y;
        if (determinant == 0.0) continue;
        const double sign = determinant > 0.0 ? 1.0 : -1.0;
        const glm::dvec3 u = (e1 * d2.y - e2 * d1.y) * sign, w = (e2 * d1.x - e1 * d2.x) * sign;
        const double area = glm::length(glm::cross(e1, e2)), u_length = glm::length(u),
                     w_length = glm::length(w);
        if (!(u_length > 0.0 && w_length > 0.0)) continue;
        for (int k = 0; k < 3; ++k) {
            along_u[v[k]] += u * (area / u_length);
            along_v[v[k]] += w * (area / w_length);
        }
    }

    // Gram-Schmidt against the normal. Handedness as glTF wants it: bitangent = cross(normal, tangent) * w
    // points to where the texture's v decreases (v runs down the image, the bitangent up).
    mesh.tangents.resize(mesh.positions.size());
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const glm::dvec3 n(mesh.normals[i]);
        const glm::dvec3 t = along_u[i] - n * glm::dot(n, along_u[i]);
        const double length = glm::length(t);
        const bool usable = length > 1e-12 * glm::length(along_u[i]) && std::isfinite(length) && length > 0.0;
        const glm::vec3 tangent = usable ? glm::vec3(t / length) : orthogonal(mesh.normals[i]);
        const double side = glm::dot(glm::cross(n, glm::dvec3(tangent)), along_v[i]);
        mesh.tangents[i] = glm::vec4(tangent, side > 0.0 ? -1.0f : 1.0f);
    }
}

void drop_unused_vertices(Mesh& mesh) {
    constexpr std::uint32_t unseen = ~0u;
    std::vector<std::uint32_t> renamed(mesh.positions.size(), unseen), order;
    for (std::uint32_t& index : mesh.indices) {
        if (renamed[index] == unseen) {
            renamed[index] = std::uint32_t(order.size());
            order.push_back(index);
        }
        index = renamed[index];
    }
    if (order.size() < mesh.positions.size())
        gather_vertices(mesh, order);
    else // every vertex is used: the file's order stands
        for (std::uint32_t& index : mesh.indices) index = order[index];
}

} // namespace luxel
