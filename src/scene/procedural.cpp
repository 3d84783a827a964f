// SPDX-License-Identifier: MIT
// Building blocks of procedural geometry: quads, boxes, solids of revolution and midpoint subdivision.
#include "scene/procedural.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>

#include "core/error.h"

namespace luxel {
namespace {

std::uint32_t add_vertex(Mesh& mesh, glm::vec3 position, glm::vec3 normal, glm::vec2 uv) {
    mesh.positions.push_back(position);
    mesh.normals.push_back(normal);
    mesh.texcoords[0].push_back(uv);
    return std::uint32_t(mesh.positions.size() - 1);
}

void add_triangle(Mesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    mesh.indices.insert(mesh.indices.end(), {a, b, c});
}

template <class T> void append_mean(std::vector<T>& values, std::uint32_t a, std::uint32_t b) {
    if (!values.empty()) values.push_back((values[a] + values[b]) * 0.5f);
}

glm::vec3 unit_or(glm::vec3 v, glm::vec3 fallback) {
    const float length = glm::length(v);
    return length > 1e-8f ? v / length : fallback;
}

// Index of the vertex halfway between two others; made once per edge.
class Midpoints {
public:
    explicit Midpoints(Mesh& mesh) : mesh_(mesh) {}

    std::uint32_t between(std::uint32_t a, std::uint32_t b) {
        const std::uint64_t key = std::uint64_t(std::min(a, b)) << 32 | std::max(a, b);
        const auto [place, is_new] = known_.try_emplace(key, std::uint32_t(mesh_.positions.size()));
        if (is_new) append(a, b);
        return place->second;
    }

private:
    void append(std::uint32_t a, std::uint32_t b) {
        append_mean(mesh_.positions, a, b);
        append_mean(mesh_.normals, a, b);
        append_mean(mesh_.tangents, a, b);
        append_mean(mesh_.texcoords[0], a, b);
        append_mean(mesh_.texcoords[1], a, b);
        append_mean(mesh_.colors, a, b);

        // Directions stay unit; the handedness in a tangent's w stays a sign.
        if (!mesh_.normals.empty()) mesh_.normals.back() = unit_or(mesh_.normals.back(), mesh_.normals[a]);
        if (!mesh_.tangents.empty()) {
            const glm::vec4 old = mesh_.tangents[a];
            mesh_.tangents.back() =
                glm::vec4(unit_or(glm::vec3(mesh_.tangents.back()), glm::vec3(old)), old.w);
        }
    }

    Mesh& mesh_;
    std::unordered_map<std::uint64_t, std::uint32_t> known_;
};

void subdivide_once(Mesh& mesh) {
    const std::vector<std::uint32_t> old = std::move(mesh.indices);
    mesh.indices.clear();
    mesh.indices.reserve(old.size() * 4);

    // Corner triangles keep their corner first and the middle one the winding.
    Midpoints midpoints(mesh);
    for (std::size_t i = 0; i + 2 < old.size(); i += 3) {
        const std::uint32_t a = old[i], b = old[i + 1], c = old[i + 2];
        const std::uint32_t ab = midpoints.between(a, b), bc = midpoints.between(b, c),
                            ca = midpoints.between(c, a);
        add_triangle(mesh, a, ab, ca);
        add_triangle(mesh, ab, b, bc);
        add_triangle(mesh, ca, bc, c);
        add_triangle(mesh, ab, bc, ca);
    }
}

} // namespace

void add_quad(Mesh& mesh, glm::vec3 corner, glm::vec3 edge_u, glm::vec3 edge_v) {
    const glm::vec3 normal = glm::normalize(glm::cross(edge_u, edge_v));
    const std::uint32_t a = add_vertex(mesh, corner, normal, {0, 0});
    const std::uint32_t b = add_vertex(mesh, corner + edge_u, normal, {1, 0});
    const std::uint32_t c = add_vertex(mesh, corner + edge_u + edge_v, normal, {1, 1});
    const std::uint32_t d = add_vertex(mesh, corner + edge_v, normal, {0, 1});
    add_triangle(mesh, a, b, c);
    add_triangle(mesh, a, c, d);
}

void add_box(Mesh& mesh, glm::vec3 least, glm::vec3 most) {
    const glm::vec3 size = most - least;
    const glm::vec3 x(size.x, 0, 0), y(0, size.y, 0), z(0, 0, size.z);
    add_quad(mesh, least, z, y);     // -x
    add_quad(mesh, least + x, y, z); // +x
    add_quad(mesh, least, x, z);     // -y
    add_quad(mesh, least + y, z, x); // +y
    add_quad(mesh, least, y, x);     // -z
    add_quad(mesh, least + z, x, y); // +z
}

void add_revolved(Mesh& mesh, glm::vec3 base, const std::vector<OutlinePoint>& outline, int slices) {
    const auto rows = std::uint32_t(outline.size());
    const auto first = std::uint32_t(mesh.positions.size());

    // One column of vertices per slice boundary; the seam is doubled so that texture coordinates do not wrap.
    for (int i = 0; i <= slices; ++i) {
        const float phi = 2.0f * shared::PI * float(i % slices) / float(slices);
        const float x = std::cos(phi), z = -std::sin(phi);
        for (std::uint32_t j = 0; j < rows; ++j) {
            const OutlinePoint& p = outline[j];
            add_vertex(mesh, base + glm::vec3(x * p.radius, p.height, z * p.radius),
                       {x * p.normal_radial, p.normal_y, z * p.normal_radial},
                       {float(i) / float(slices), float(j) / float(rows - 1)});
        }
    }

    // Two triangles per cell; on the axis one of them would have no area.
    for (std::uint32_t i = 0; i < std::uint32_t(slices); ++i) {
        for (std::uint32_t j = 0; j + 1 < rows; ++j) {
            const std::uint32_t a = first + i * rows + j, b = a + rows;
            if (outline[j].radius > 0.0f) add_triangle(mesh, a, b, b + 1);
            if (outline[j + 1].radius > 0.0f) add_triangle(mesh, a, b + 1, a + 1);
        }
    }
}

void add_sphere(Mesh& mesh, glm::vec3 center, float radius, int slices, int stacks) {
    LUXEL_ASSERT(slices >= 3 && stacks >= 2, "slices={} stacks={}", slices, stacks);
    std::vector<OutlinePoint> outline;
    for (int j = 0; j <= stacks; ++j) {
        const float theta = shared::PI * float(j) / float(stacks);
        const float s = j == 0 || j == stacks ? 0.0f : std::sin(theta), c = -std::cos(theta);
        outline.push_back({radius * s, radius * c, s, c});
    }
    add_revolved(mesh, center, outline, slices);
}

void add_cylinder(Mesh& mesh, glm::vec3 base, float radius, float height, int slices) {
    LUXEL_ASSERT(slices >= 3, "slices={}", slices);
    add_revolved(mesh, base, {{0, 0, 0, -1}, {radius, 0, 0, -1}}, slices);
    add_revolved(mesh, base, {{radius, 0, 1, 0}, {radius, height, 1, 0}}, slices);
    add_revolved(mesh, base, {{radius, height, 0, 1}, {0, height, 0, 1}}, slices);
}

void add_cone(Mesh& mesh, glm::vec3 base, float radius, float height, int slices) {
    LUXEL_ASSERT(slices >= 3, "slices={}", slices);
    const float slant = std::hypot(radius, height);
    const float radial = height / slant, vertical = radius / slant;
    add_revolved(mesh, base, {{0, 0, 0, -1}, {radius, 0, 0, -1}}, slices);
    add_revolved(mesh, base, {{radius, 0, radial, vertical}, {0, height, radial, vertical}}, slices);
}

void add_torus(Mesh& mesh, glm::vec3 center, float ring_radius, float tube_radius, int slices, int stacks) {
    LUXEL_ASSERT(slices >= 3 && stacks >= 3 && ring_radius > tube_radius, "slices={} stacks={} radii={}, {}",
                 slices, stacks, ring_radius, tube_radius);
    std::vector<OutlinePoint> outline;
    for (int j = 0; j <= stacks; ++j) {
        const float psi = 2.0f * shared::PI * float(j % stacks) / float(stacks);
        const float c = std::cos(psi), s = std::sin(psi);
        outline.push_back({ring_radius + tube_radius * c, tube_radius * s, c, s});
    }
    add_revolved(mesh, center, outline, slices);
}

std::vector<OutlinePoint> smooth_outline(const std::vector<glm::vec2>& points, int steps) {
    LUXEL_ASSERT(points.size() >= 2 && steps >= 1, "points={} steps={}", points.size(), steps);
    std::vector<OutlinePoint> outline;
    const std::size_t spans = points.size() - 1;

    // Hermite spans whose tangents are half the way between the neighbors, as Catmull and Rom have it.
    for (std::size_t i = 0; i < spans; ++i) {
        const glm::vec2 a = points[i], b = points[i + 1];
        const glm::vec2 at_a = i > 0 ? (b - points[i - 1]) * 0.5f : b - a;
        const glm::vec2 at_b = i + 1 < spans ? (points[i + 2] - a) * 0.5f : b - a;
        for (int k = 0; k < steps + (i + 1 == spans ? 1 : 0); ++k) {
            const float t = float(k) / float(steps), t2 = t * t, t3 = t2 * t;
            const glm::vec2 p = a * (2 * t3 - 3 * t2 + 1) + b * (3 * t2 - 2 * t3) + at_a * (t3 - 2 * t2 + t) +
                                at_b * (t3 - t2);
            const glm::vec2 along = glm::normalize((b - a) * (6 * t - 6 * t2) + at_a * (3 * t2 - 4 * t + 1) +
                                                   at_b * (3 * t2 - 2 * t));
            const bool on_axis = p.x <= 0.0f;
            outline.push_back({on_axis ? 0.0f : p.x, p.y, on_axis ? 0.0f : along.y,
                               on_axis ? std::copysign(1.0f, -along.x) : -along.x});
        }
    }
    return outline;
}

void add_height_field(Mesh& mesh, float half, int cells,
                      const std::function<glm::vec3(float x, float z)>& height) {
    LUXEL_ASSERT(cells >= 1, "cells={}", cells);
    const auto first = std::uint32_t(mesh.positions.size()), columns = std::uint32_t(cells) + 1;
    for (std::uint32_t j = 0; j < columns; ++j)
        for (std::uint32_t i = 0; i < columns; ++i) {
            const glm::vec2 uv(float(i) / float(cells), float(j) / float(cells));
            const float x = half * (2.0f * uv.x - 1.0f), z = half * (2.0f * uv.y - 1.0f);
            const glm::vec3 h = height(x, z);
            add_vertex(mesh, {x, h.x, z}, glm::normalize(glm::vec3(-h.y, 1.0f, -h.z)), uv);
        }
    for (std::uint32_t j = 0; j + 1 < columns; ++j)
        for (std::uint32_t i = 0; i + 1 < columns; ++i) {
            const std::uint32_t a = first + j * columns + i, b = a + columns;
            add_triangle(mesh, a, b, b + 1);
            add_triangle(mesh, a, b + 1, a + 1);
        }
}

Scene subdivide(const Scene& scene, int levels) {
    LUXEL_ASSERT(levels >= 0, "levels={}", levels);
    Scene fine = scene;
    for (Mesh& mesh : fine.meshes)
        for (int level = 0; level < levels; ++level) subdivide_once(mesh);
    return fine;
}

} // namespace luxel
