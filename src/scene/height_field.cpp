// SPDX-License-Identifier: MIT
#include "scene/height_field.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "scene/shading_mesh.h"
#include "scene/surface.h"

namespace luxel {
namespace {

using shared::HeightField;
using shared::TextureAxes;

// A corner of a triangle, in world space.
struct Corner {
    glm::vec3 position, normal;
    glm::vec4 tangent, color;
    glm::vec2 uv[2];
};

// Values at lattice point (i, j, k), i + j + k = n. On an edge one weight is 0 and the sum of the two others
// does not depend on their order: neighbors get the same bits.
template <class T> T blend(const T& a, const T& b, const T& c, glm::vec3 w) {
    return a * w.x + b * w.y + c * w.z;
}
Corner blend(const Corner (&c)[3], glm::vec3 w) {
    Corner r;
    r.position = blend(c[0].position, c[1].position, c[2].position, w);
    r.normal = blend(c[0].normal, c[1].normal, c[2].normal, w);
    r.tangent = blend(c[0].tangent, c[1].tangent, c[2].tangent, w);
    r.color = blend(c[0].color, c[1].color, c[2].color, w);
    for (int s = 0; s < 2; ++s) r.uv[s] = blend(c[0].uv[s], c[1].uv[s], c[2].uv[s], w);
    return r;
}

glm::vec3 unit_or(glm::vec3 v, glm::vec3 otherwise) {
    const float length = glm::length(v);
    return length > 0.0f ? v / length : otherwise;
}

class Tessellator {
public:
    Tessellator(const Scene& scene, const Instance& instance, float edge)
        : scene_(scene), instance_(instance), mesh_(scene.meshes[std::size_t(instance.mesh)]),
          material_(scene.materials[std::size_t(mesh_.material)]),
          mirrored_(handedness(instance.transform) < 0.0f), field_(height_field(scene, material_)),
          edge_(edge) {
        const glm::mat3 m(instance.transform);
        to_normal_ = glm::mat3(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1])) *
                     (mirrored_ ? -1.0f : 1.0f);
    }

    // One count for all triangles, so that neighbors share the vertices of their edge.
    std::uint64_t segments() const {
        double most = 1.0;
        for (std::size_t t = 0; t < mesh_.indices.size(); t += 3) {
            Corner c[3];
            read(t, c);
            for (int k = 0; k < 3; ++k) {
                const Corner &a = c[k], &b = c[(k + 1) % 3];
                const glm::vec2 texels = (height_uv(b) - height_uv(a)) * field_.size;
                // Diagonals of a quad run across texels in both directions: legs count, not their length.
                most =
                    std::max(most, edge_ > 0.0f ? double(glm::length(b.position - a.position)) / double(edge_)
                                                : double(std::max(std::abs(texels.x), std::abs(texels.y))));
            }
        }
        return std::uint64_t(std::ceil(std::min(most - 1e-3, 1e6)));
    }

    Mesh run(std::uint64_t n) const {
        Mesh out;
        out.name = mesh_.name;
        out.material = mesh_.material;
        for (std::size_t t = 0; t < mesh_.indices.size(); t += 3) {
            Corner c[3];
            read(t, c);
            split(out, c, std::uint32_t(n));
        }
        return out;
    }

private:
    // In counter-clockwise order in world space: winding says what is front in object space only.
    void read(std::size_t first_index, Corner (&c)[3]) const {
        for (int k = 0; k < 3; ++k) {
            const std::uint32_t i = mesh_.indices[first_index + std::size_t(mirrored_ ? 2 - k : k)];
            c[k].position = transform_point(instance_.transform, mesh_.positions[i]);
            c[k].normal = glm::normalize(to_normal_ * mesh_.normals[i]);
            c[k].tangent = glm::vec4(0.0f);
            if (!mesh_.tangents.empty())
                c[k].tangent =
                    glm::vec4(glm::normalize(glm::mat3(instance_.transform) * glm::vec3(mesh_.tangents[i])),
                              mesh_.tangents[i].w * (mirrored_ ? -1.0f : 1.0f));
            c[k].color = mesh_.colors.empty() ? glm::vec4(1.0f) : mesh_.colors[i];
            for (int s = 0; s < 2; ++s)
                c[k].uv[s] = mesh_.texcoords[s].empty() ? glm::vec2(0.0f) : mesh_.texcoords[s][i];
        }
    }

    glm::vec2 height_uv(const Corner& c) const {
        const TextureUse& use = material_.height_texture;
        return glm::vec2(use.transform * glm::vec3(c.uv[use.set], 1.0f));
    }

    void split(Mesh& out, const Corner (&c)[3], std::uint32_t n) const {
        const glm::vec3 edge1 = c[1].position - c[0].position, edge2 = c[2].position - c[0].position;
        const TextureAxes axes = shared::texture_axes(edge1, edge2, height_uv(c[1]) - height_uv(c[0]),
                                                      height_uv(c[2]) - height_uv(c[0]));
        const glm::vec3 plane = unit_or(glm::cross(edge1, edge2), c[0].normal);

        // Rows of the lattice, from corner 0 to the opposite edge.
        const auto first = std::uint32_t(out.positions.size());
        for (std::uint32_t row = 0; row <= n; ++row)
            for (std::uint32_t k = 0; k <= row; ++k)
                add(out, blend(c, glm::vec3(float(n - row), float(row - k), float(k)) / float(n)), axes,
                    plane);
        const auto at = [first](std::uint32_t row, std::uint32_t k) {
            return first + row * (row + 1) / 2 + k;
        };
        for (std::uint32_t row = 0; row < n; ++row)
            for (std::uint32_t k = 0; k <= row; ++k) {
                out.indices.insert(out.indices.end(), {at(row, k), at(row + 1, k), at(row + 1, k + 1)});
                if (k < row)
                    out.indices.insert(out.indices.end(), {at(row, k), at(row + 1, k + 1), at(row, k + 1)});
            }
    }

    void add(Mesh& out, const Corner& c, const TextureAxes& axes, glm::vec3 plane) const {
        const glm::vec2 uv = height_uv(c);
        const glm::vec3 n = unit_or(c.normal, plane);
        const float depth = (1.0f - height_at(field_, uv)) * material_.height_scale;
        const bool mapped = material_.normal_texture.texture >= 0;
        out.positions.push_back(c.position - n * depth);
        out.normals.push_back(mapped ? n
                                     : shared::relief_normal(n, shared::height_gradient(field_, uv), axes,
                                                             material_.height_scale));
        for (int s = 0; s < 2; ++s)
            if (!mesh_.texcoords[s].empty()) out.texcoords[s].push_back(c.uv[s]);
        if (!mesh_.colors.empty()) out.colors.push_back(c.color);
        if (!mesh_.tangents.empty())
            out.tangents.push_back(glm::vec4(unit_or(glm::vec3(c.tangent), glm::normalize(axes.u + plane)),
                                             c.tangent.w < 0.0f ? -1.0f : 1.0f));
    }

    const Scene& scene_;
    const Instance& instance_;
    const Mesh& mesh_;
    const Material& material_;
    bool mirrored_;
    glm::mat3 to_normal_;
    HeightField field_;
    float edge_;
};

} // namespace

HeightField height_field(const Scene& scene, const Material& material) {
    const Texture& texture = scene.textures[std::size_t(material.height_texture.texture)];
    return {{float(texture.pixels.width), float(texture.pixels.height)},
            [&texture](glm::vec2 uv) { return sample_texture(texture, uv).r; }};
}

bool has_height_fields(const Scene& scene) {
    return std::any_of(scene.meshes.begin(), scene.meshes.end(), [&](const Mesh& mesh) {
        return scene.materials[std::size_t(mesh.material)].has_relief();
    });
}

Scene with_height_fields(const Scene& scene, float edge) {
    Scene result = scene;
    if (!has_height_fields(scene)) return result;
    std::uint64_t triangles = 0;
    for (Instance& instance : result.instances) {
        const Mesh& mesh = scene.meshes[std::size_t(instance.mesh)];
        if (!scene.materials[std::size_t(mesh.material)].has_relief()) continue;
        const Instance original = instance;
        const Tessellator tessellator(scene, original, edge);
        const std::uint64_t n = tessellator.segments();
        triangles += mesh.indices.size() / 3 * n * n;
        if (triangles > max_relief_triangles)
            fail(Fault::resource,
                 "{}: {}: its height map asks for more than {} triangles; use a smaller map, or fewer and "
                 "larger "
                 "triangles under it",
                 scene.name, instance.name, max_relief_triangles);
        instance.mesh = int(result.meshes.size());
        instance.transform = glm::mat4(1.0f);
        result.meshes.push_back(tessellator.run(n));
    }

    // No relief is applied twice.
    for (Material& material : result.materials) material.height_texture = {}, material.height_scale = 0.0f;
    return result;
}

} // namespace luxel
