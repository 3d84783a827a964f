// SPDX-License-Identifier: MIT
// Tangents from texture coordinates, by the rules of MikkTSpace [Mikkelsen2008].
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numeric>
#include <tuple>
#include <unordered_map>

#include "scene/mesh_attributes.h"

namespace luxel {
namespace {

enum class Side : std::uint32_t {
    straight,
    mirrored,
    none
}; // of the texture on a face; none: no texture axes

// Any unit vector orthogonal to n.
glm::dvec3 orthogonal(const glm::dvec3& n) {
    const glm::dvec3 axis = std::abs(n.x) < 0.9 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    return glm::normalize(axis - n * glm::dot(n, axis));
}

glm::dvec3 in_plane(const glm::dvec3& v, const glm::dvec3& normal) {
    return v - normal * glm::dot(normal, v);
}

glm::dvec3 unit_or_zero(const glm::dvec3& v) {
    const double length = glm::length(v);
    return length > 0.0 && std::isfinite(length) ? v / length : glm::dvec3(0.0);
}

// Corners, joined into groups that share a tangent.
class Groups {
public:
    explicit Groups(std::size_t corners) : parent_(corners) { std::iota(parent_.begin(), parent_.end(), 0u); }
    std::uint32_t root(std::uint32_t corner) {
        while (parent_[corner] != corner) corner = parent_[corner] = parent_[parent_[corner]];
        return corner;
    }
    void join(std::uint32_t a, std::uint32_t b) { parent_[root(b)] = root(a); }

private:
    std::vector<std::uint32_t> parent_;
};

class TangentMaker {
public:
    TangentMaker(Mesh& mesh, int set, const glm::mat3& uv_transform)
        : mesh_(mesh), corners_(mesh.indices.size()), groups_(corners_) {
        for (std::size_t v = 0; v < mesh.positions.size(); ++v)
            uvs_.emplace_back(mesh.texcoords[set].empty()
                                  ? glm::vec3(0.0f)
                                  : uv_transform * glm::vec3(mesh.texcoords[set][v], 1.0f));
    }

    void run() {
        weld();
        for (std::size_t i = 0; i < corners_; i += 3) add_face(i);
        join_faces();
        split();
    }

private:
    // Vertices that are equal in all that counts have one number.
    void weld() {
        using Key = std::array<float, 8>;
        const auto hash = [](const Key& key) {
            std::size_t h = 0;
            for (const float f : key)
                h = (h ^ std::bit_cast<std::uint32_t>(f)) * 0x9e3779b97f4a7c15u, h ^= h >> 29;
            return h;
        };
        std::unordered_map<Key, std::uint32_t, decltype(hash)> number(mesh_.positions.size(), hash);
        for (std::size_t v = 0; v < mesh_.positions.size(); ++v) {
            const glm::vec3 p = mesh_.positions[v] + 0.0f, n = mesh_.normals[v] + 0.0f; // -0 becomes 0
            const glm::vec2 t = glm::vec2(uvs_[v]) + 0.0f;
            welded_.push_back(
                number.try_emplace({p.x, p.y, p.z, n.x, n.y, n.z, t.x, t.y}, std::uint32_t(v)).first->second);
        }
    }

    glm::dvec3 position(std::size_t corner) const {
        return glm::dvec3(mesh_.positions[mesh_.indices[corner]]);
    }
    glm::dvec2 uv(std::size_t corner) const { return glm::dvec2(uvs_[mesh_.indices[corner]]); }
    static std::size_t next(std::size_t corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; }

    // The direction of +u on a face, and on which side its texture is.
    void add_face(std::size_t first) {
        const glm::dvec2 d1 = uv(first + 1) - uv(first), d2 = uv(first + 2) - uv(first);
        const glm::dvec3 e1 = position(first + 1) - position(first),
                         e2 = position(first + 2) - position(first);
        const double determinant = d1.x * d2.y - d1.y * d2.x;
        const glm::dvec3 u = (e1 * d2.y - e2 * d1.y) * (determinant < 0.0 ? -1.0 : 1.0);
        along_u_.push_back(unit_or_zero(u));
        const bool usable =
            determinant != 0.0 && std::isfinite(determinant) && along_u_.back() != glm::dvec3(0.0);
        sides_.push_back(!usable ? Side::none : determinant < 0.0 ? Side::mirrored : Side::straight);
    }

    // Corners at one vertex that have an edge in common belong together if their texture is on the same side.
    // Faces without texture axes follow a neighbor.
    void join_faces() {
        using Edge =
            std::tuple<std::uint32_t, std::uint32_t, Side, std::uint32_t>; // vertex, other end, side, corner
        std::vector<Edge> edges;
        edges.reserve(corners_ * 2);
        for (std::size_t c = 0; c < corners_; ++c) {
            const std::uint32_t at = welded_[mesh_.indices[c]];
            for (const std::size_t other : {next(c), next(next(c))})
                edges.emplace_back(at, welded_[mesh_.indices[other]], sides_[c / 3], std::uint32_t(c));
        }
        std::sort(edges.begin(), edges.end());
        const auto same_edge = [](const Edge& a, const Edge& b) {
            return std::get<0>(a) == std::get<0>(b) && std::get<1>(a) == std::get<1>(b);
        };
        for (std::size_t i = 1; i < edges.size(); ++i)
            if (same_edge(edges[i - 1], edges[i]) && std::get<2>(edges[i - 1]) == std::get<2>(edges[i]))
                groups_.join(std::get<3>(edges[i - 1]), std::get<3>(edges[i]));
        for (std::size_t i = 1; i < edges.size(); ++i) {
            const std::uint32_t with = std::get<3>(edges[i - 1]), without = std::get<3>(edges[i]);
            if (!same_edge(edges[i - 1], edges[i]) || std::get<2>(edges[i]) != Side::none) continue;
            if (sides_[groups_.root(without) / 3] == Side::none &&
                sides_[groups_.root(with) / 3] != Side::none)
                groups_.join(with, without);
        }
    }

    // What a corner adds to its group: +u in the plane of the normal, by the angle between the edges there.
    glm::dvec3 share(std::size_t corner) const {
        const glm::dvec3 n(mesh_.normals[mesh_.indices[corner]]);
        const glm::dvec3 a = unit_or_zero(in_plane(position(next(corner)) - position(corner), n)),
                         b = unit_or_zero(in_plane(position(next(next(corner))) - position(corner), n));
        return unit_or_zero(in_plane(along_u_[corner / 3], n)) *
               std::acos(glm::clamp(glm::dot(a, b), -1.0, 1.0));
    }

    // One vertex for each group that uses it; the handedness is such that the bitangent, cross(normal,
    // tangent) * w, points to where v decreases (v runs down the image, the bitangent up).
    void split() {
        std::vector<glm::dvec3> sums(corners_, glm::dvec3(0.0));
        for (std::uint32_t c = 0; c < corners_; ++c)
            if (sides_[c / 3] != Side::none) sums[groups_.root(c)] += share(c);

        std::vector<std::uint32_t> order(mesh_.positions.size());
        std::iota(order.begin(), order.end(), 0u);
        constexpr std::uint32_t nobody = ~0u;
        std::vector<std::uint32_t> owner(order.size(), nobody); // group of each vertex
        std::unordered_map<std::uint64_t, std::uint32_t> further;
        for (std::uint32_t c = 0; c < corners_; ++c) {
            const std::uint32_t vertex = mesh_.indices[c], group = groups_.root(c);
            if (owner[vertex] == nobody) owner[vertex] = group;
            if (owner[vertex] == group) continue;
            const auto [place, added] =
                further.try_emplace(std::uint64_t(vertex) << 32 | group, std::uint32_t(order.size()));
            if (added) order.push_back(vertex), owner.push_back(group);
            mesh_.indices[c] = place->second;
        }
        mesh_.tangents.clear();
        gather_vertices(mesh_, order);
        for (std::size_t v = 0; v < order.size(); ++v) {
            const glm::dvec3 n(mesh_.normals[v]);
            const bool used = owner[v] != nobody;
            const glm::dvec3 t = used ? unit_or_zero(in_plane(sums[owner[v]], n)) : glm::dvec3(0.0);
            const bool straight = used && sides_[owner[v] / 3] == Side::straight;
            mesh_.tangents.emplace_back(glm::vec3(t == glm::dvec3(0.0) ? orthogonal(n) : t),
                                        straight ? -1.0f : 1.0f);
        }
    }

    Mesh& mesh_;
    std::size_t corners_;
    Groups groups_;
    std::vector<glm::vec3> uvs_; // transformed
    std::vector<std::uint32_t> welded_;
    std::vector<glm::dvec3> along_u_; // by face
    std::vector<Side> sides_;
};

} // namespace

void make_tangents(Mesh& mesh, int set, const glm::mat3& uv_transform) {
    TangentMaker(mesh, set, uv_transform).run();
}

} // namespace luxel
