// SPDX-License-Identifier: MIT
#include "scene/obj_normals.h"

#include <cmath>
#include <optional>
#include <unordered_map>

#include <glm/glm.hpp>
#include <tiny_obj_loader.h>

namespace luxel {
namespace {

struct Face {
    glm::dvec3 corners[3];
    glm::dvec3 normal; // unit; zero without area

    double angle(int k) const {
        const glm::dvec3 a = corners[(k + 1) % 3] - corners[k], b = corners[(k + 2) % 3] - corners[k];
        return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
    }
};

std::optional<Face> face_of(const tinyobj::attrib_t& attributes, const tinyobj::index_t* corners) {
    Face face;
    for (int k = 0; k < 3; ++k) {
        const int vertex = corners[k].vertex_index;
        if (vertex < 0 || std::size_t(vertex) >= attributes.vertices.size() / 3) return std::nullopt;
        for (int c = 0; c < 3; ++c)
            face.corners[k][c] = double(attributes.vertices[std::size_t(vertex) * 3 + std::size_t(c)]);
    }
    face.normal = glm::cross(face.corners[1] - face.corners[0], face.corners[2] - face.corners[0]);
    const double length = glm::length(face.normal);
    face.normal = length > 0.0 && std::isfinite(length) ? face.normal / length : glm::dvec3(0.0);
    return face;
}

int append(tinyobj::attrib_t& attributes, glm::dvec3 normal) {
    for (int c = 0; c < 3; ++c) attributes.normals.push_back(float(normal[c]));
    return int(attributes.normals.size() / 3) - 1;
}

// body(face, corners, group) for each triangle with valid vertices.
template <class Body>
void for_each_face(tinyobj::attrib_t& attributes, std::vector<tinyobj::shape_t>& shapes, Body&& body) {
    for (tinyobj::shape_t& shape : shapes)
        for (std::size_t f = 0; f * 3 + 2 < shape.mesh.indices.size(); ++f) {
            tinyobj::index_t* corners = &shape.mesh.indices[f * 3];
            const auto& groups = shape.mesh.smoothing_group_ids;
            if (const std::optional<Face> face = face_of(attributes, corners))
                body(*face, corners, f < groups.size() ? groups[f] : 0u);
        }
}

} // namespace

void add_missing_normals(tinyobj::attrib_t& attributes, std::vector<tinyobj::shape_t>& shapes) {
    // Groups are those of the whole file: materials and objects may part what is
    // smooth.
    struct Smooth {
        glm::dvec3 sum{0.0};
        int index = -1;
    };
    const auto key = [](unsigned group, int vertex) {
        return std::uint64_t(group) << 32 | std::uint32_t(vertex);
    };
    std::unordered_map<std::uint64_t, Smooth> smooth;
    for_each_face(attributes, shapes, [&](const Face& face, tinyobj::index_t* corners, unsigned group) {
        for (int k = 0; k < 3 && group != 0; ++k)
            smooth[key(group, corners[k].vertex_index)].sum += face.normal * face.angle(k);
    });

    for_each_face(attributes, shapes, [&](const Face& face, tinyobj::index_t* corners, unsigned group) {
        int flat = -1;
        for (int k = 0; k < 3; ++k) {
            if (corners[k].normal_index >= 0) continue;
            if (group != 0) {
                Smooth& s = smooth[key(group, corners[k].vertex_index)];
                // Faces that cancel one another: each has its own.
                const double length = glm::length(s.sum);
                if (s.index < 0 && length > 1e-9) s.index = append(attributes, s.sum / length);
                corners[k].normal_index = s.index;
            }
            if (corners[k].normal_index < 0)
                corners[k].normal_index = flat >= 0 ? flat : (flat = append(attributes, face.normal));
        }
    });
}

} // namespace luxel
