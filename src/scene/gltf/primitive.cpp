// SPDX-License-Identifier: MIT
#include "scene/gltf/primitive.h"

#include <algorithm>
#include <numeric>

#include "scene/gltf/accessor.h"
#include "scene/gltf/extensions.h"
#include "scene/mesh_attributes.h"
#include "scene/recenter.h"

namespace luxel::gltf {
namespace {

enum class Mode : std::uint64_t { points, lines, line_loop, line_strip, triangles, strip, fan };

// Any triangle mode to a plain list. The winding of a strip alternates.
std::vector<std::uint32_t> to_triangle_list(std::vector<std::uint32_t> corners, Mode mode) {
    if (mode == Mode::triangles) {
        corners.resize(corners.size() / 3 * 3);
        return corners;
    }
    std::vector<std::uint32_t> list;
    if (corners.size() < 3) return list;
    list.reserve((corners.size() - 2) * 3);
    for (std::size_t i = 0; i + 2 < corners.size(); ++i) {
        const std::size_t odd = i % 2;
        if (mode == Mode::strip)
            list.insert(list.end(), {corners[i], corners[i + 1 + odd], corners[i + 2 - odd]});
        if (mode == Mode::fan) list.insert(list.end(), {corners[0], corners[i + 1], corners[i + 2]});
    }
    return list;
}

// Draco leaves accessors without data behind: all zeros would be a scene, but not this one.
void refuse_draco_without_fallback(const Document& document, const Value& primitive, const Value& position) {
    if (primitive["extensions"]["KHR_draco_mesh_compression"] && position &&
        !document.resolve("accessors", position)["bufferView"])
        primitive.fail("is compressed with KHR_draco_mesh_compression, which is not supported; "
                       "store it uncompressed or with EXT_meshopt_compression");
}

std::vector<std::uint32_t> read_corners(Document& document, const Value& primitive, std::size_t vertices,
                                        Mode mode) {
    std::vector<std::uint32_t> corners;
    const Value indices = primitive["indices"];
    if (indices) {
        corners = read_indices(document, indices);
        const auto largest = std::max_element(corners.begin(), corners.end());
        if (*largest >= vertices)
            indices.fail("index {} is out of range, there are {} vertices", *largest, vertices);
    } else {
        document.charge(vertices, sizeof(std::uint32_t));
        corners.resize(vertices);
        std::iota(corners.begin(), corners.end(), 0u);
    }
    if (mode != Mode::triangles) document.charge(corners.size(), 3 * sizeof(std::uint32_t));
    return to_triangle_list(std::move(corners), mode);
}

// A vertex attribute, empty when the primitive has none; as many elements as vertices.
template <class Read>
auto attribute(Document& document, const Value& reference, std::size_t vertices, Read read) {
    decltype(read(document, reference)) values;
    if (!reference) return values;
    const std::uint64_t count = accessor_count(document, reference);
    if (count != vertices) reference.fail("has {} elements for {} vertices", count, vertices);
    values = read(document, reference);
    return values;
}

// Replaces elements that are not finite and counts them.
template <class T>
void replace_bad(Document& document, std::vector<T>& values, const T& by, const char* sentence) {
    int count = 0;
    for (T& v : values)
        if (!is_finite(v)) v = by, ++count;
    if (count > 0) document.warn(sentence, count);
}

void read_attributes(Document& document, const Value& attributes, Mesh& mesh) {
    const std::size_t vertices = mesh.positions.size();
    mesh.normals = attribute(document, attributes["NORMAL"], vertices, read_vec3);
    mesh.texcoords[0] = attribute(document, attributes["TEXCOORD_0"], vertices, read_vec2);
    mesh.texcoords[1] = attribute(document, attributes["TEXCOORD_1"], vertices, read_vec2);
    mesh.colors = attribute(document, attributes["COLOR_0"], vertices,
                            [](Document& d, const Value& v) { return read_vec4(d, v, true); });
    // Without normals the file's tangents mean nothing: glTF 2.0, section 3.7.2.1, says to ignore them.
    if (!mesh.normals.empty())
        mesh.tangents = attribute(document, attributes["TANGENT"], vertices,
                                  [](Document& d, const Value& v) { return read_vec4(d, v); });
}

// Values that are not finite. Positions cannot be guessed: their triangles go.
void repair_values(Document& document, Mesh& mesh) {
    if (const int dropped = drop_bad_triangles(mesh))
        document.warn("triangles with a position that is not finite are left out", dropped);
    replace_bad(document, mesh.texcoords[0], glm::vec2(0.0f),
                "texture coordinates that are not finite are replaced by 0");
    replace_bad(document, mesh.texcoords[1], glm::vec2(0.0f),
                "texture coordinates that are not finite are replaced by 0");
    replace_bad(document, mesh.colors, glm::vec4(1.0f),
                "vertex colors that are not finite are replaced by white");
    replace_bad(document, mesh.tangents, glm::vec4(0.0f),
                "tangents that are not finite are left out, and their mesh's made from texture coordinates");
}

void complete_normals(Document& document, Mesh& mesh) {
    if (mesh.normals.empty()) {
        document.charge(mesh.indices.size(),
                        2 * sizeof(glm::vec3) + 2 * sizeof(glm::vec2) + sizeof(glm::vec4));
        make_flat(mesh);
    }
    if (const int repaired = repair_normals(mesh))
        document.warn(
            "normals that are not finite or of no length are replaced by those of the faces around them",
            repaired);
}

bool usable(const std::vector<glm::vec4>& tangents) {
    return !tangents.empty() && std::all_of(tangents.begin(), tangents.end(), [](const glm::vec4& t) {
        return glm::dot(glm::vec3(t), glm::vec3(t)) > 1e-12f && t.w != 0.0f;
    });
}

// Tangents only where a normal texture needs them.
void complete_tangents(Document& document, Mesh& mesh, const TextureUse& normal_texture) {
    if (normal_texture.texture < 0) {
        mesh.tangents.clear();
    } else if (usable(mesh.tangents)) {
        for (glm::vec4& t : mesh.tangents)
            t = glm::vec4(as_unit(glm::vec3(t)), t.w < 0.0f ? -1.0f : 1.0f);
    } else {
        document.charge(mesh.indices.size(), tangent_bytes_per_corner);
        make_tangents(mesh, normal_texture.set, normal_texture.transform);
    }
}

} // namespace

std::optional<Primitive> read_primitive(Document& document, const Value& primitive, const Scene& scene,
                                        int default_material, const Deformation& deformation) {
    const std::uint64_t mode_code = primitive["mode"].integer(4);
    if (mode_code > std::uint64_t(Mode::fan)) primitive.fail("{} is not a primitive mode", mode_code);
    const Mode mode = Mode(mode_code);
    if (mode < Mode::triangles) {
        document.warn("points and lines are not drawn");
        return std::nullopt;
    }
    warn_of_extensions(document, primitive, Bearer::primitive);

    Primitive result;
    Mesh& mesh = result.mesh;
    const Value material = primitive["material"];
    mesh.material =
        material ? int(material.index(std::size_t(default_material), "material")) : default_material;

    const Value attributes = primitive["attributes"], position = attributes["POSITION"];
    if (!position) {
        document.warn("a primitive without positions is not drawn");
        return std::nullopt;
    }
    refuse_draco_without_fallback(document, primitive, position);
    mesh.positions = read_vec3(document, position);
    read_attributes(document, attributes, mesh);
    mesh.indices = read_corners(document, primitive, mesh.positions.size(), mode);
    if (mesh.indices.empty()) {
        document.warn("a primitive with fewer than three vertices is not drawn");
        return std::nullopt;
    }

    // At rest: morph targets by their weights, then the skin. Skinned vertices are moved to their middle
    // already.
    morph(document, primitive, deformation.weights, mesh);
    if (deformation.joints)
        result.skinned = apply_skin(document, primitive, *deformation.joints, mesh, result.middle);
    if (deformation.joints && !result.skinned)
        document.warn("a mesh without joints does not follow its skin");
    repair_values(document, mesh);
    if (mesh.indices.empty()) {
        document.warn("a primitive without finite triangles is not drawn");
        return std::nullopt;
    }

    // Exporters share one large vertex array between primitives: then most vertices of each copy are unused.
    if (mesh.positions.size() > mesh.indices.size()) drop_unused_vertices(mesh);
    for (glm::vec3& p : mesh.positions)
        if (!is_finite(p)) p = mesh.positions[mesh.indices[0]]; // no triangle has it any more
    if (!result.skinned) result.middle = recenter(mesh);
    complete_normals(document, mesh);
    complete_tangents(document, mesh, scene.materials[std::size_t(mesh.material)].normal_texture);
    return result;
}

} // namespace luxel::gltf
