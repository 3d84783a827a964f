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

} // namespace

void gather_vertices(Mesh& mesh, const std::vector<std::uint32_t>& order) {
    gather(mesh.positions, order);
    gather(mesh.normals, order);
    gather(mesh.tangents, order);
    for (auto& set : mesh.texcoords) gather(set, order);
    gather(mesh.colors, order);
}

void make_flat(Mesh& mesh) {
    gather_vertices(mesh, mesh.indices);
    for (std::size_t i = 0; i < mesh.indices.size(); ++i) mesh.indices[i] = std::uint32_t(i);
    mesh.normals.resize(mesh.positions.size());
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
        mesh.normals[i] = mesh.normals[i + 1] = mesh.normals[i + 2] = unit_or_up(area_normal(mesh, i));
}

glm::vec3 as_unit(glm::vec3 v) {
    constexpr double rounding = 1e-7; // of each component half a unit in the last place, 3e-8
    const double length = glm::length(glm::dvec3(v));
    return std::abs(length - 1.0) < rounding ? v : glm::vec3(glm::dvec3(v) / length);
}

int repair_normals(Mesh& mesh) {
    constexpr double shortest = 1e-6;
    int broken = 0;
    for (glm::vec3& n : mesh.normals) {
        const double length = glm::length(glm::dvec3(n));
        const bool sound = length > shortest && std::isfinite(length);
        n = sound ? as_unit(n) : glm::vec3(0.0f);
        broken += !sound;
    }
    if (broken == 0) return 0;

    std::vector<glm::dvec3> sums(mesh.positions.size(), glm::dvec3(0.0));
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const glm::dvec3 n = area_normal(mesh, i);
        for (std::size_t k = 0; k < 3; ++k) sums[mesh.indices[i + k]] += n;
    }
    for (std::size_t v = 0; v < mesh.normals.size(); ++v)
        if (mesh.normals[v] == glm::vec3(0.0f)) mesh.normals[v] = unit_or_up(sums[v]);
    return broken;
}

int drop_bad_triangles(Mesh& mesh) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const glm::dvec3 n = area_normal(mesh, i); // of positions that are not finite it is no number
        if (!std::isfinite(n.x + n.y + n.z)) continue;
        for (std::size_t k = 0; k < 3; ++k) mesh.indices[kept + k] = mesh.indices[i + k];
        kept += 3;
    }
    const std::size_t dropped = (mesh.indices.size() - kept) / 3;
    mesh.indices.resize(kept);
    return int(dropped);
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
