// SPDX-License-Identifier: MIT
// Geometry as mesh2 in object space; vertex colors as a list of textures that POV-Ray interpolates.
#include <array>
#include <map>

#include "core/image.h"
#include "scene/export/povray/text.h"

namespace luxel::povray {
namespace {

constexpr int color_levels = 31; // of each sRGB-coded channel: POV-Ray keeps a whole texture for each color

glm::vec2 mapped(const TextureUse& use, glm::vec2 uv) {
    return glm::vec2(use.transform * glm::vec3(uv, 1.0f));
}

// The set that the material's base color goes by, transformed; empty without one.
std::vector<glm::vec2> texture_coordinates(const Mesh& mesh, const Material& material) {
    const TextureUse& use = material.base_color_texture;
    std::vector<glm::vec2> uvs = mesh.texcoords[use.set];
    if (use.texture < 0) uvs.clear();
    for (glm::vec2& uv : uvs) uv = mapped(use, uv);
    return uvs;
}

glm::ivec3 quantized(glm::vec3 linear) {
    glm::ivec3 levels;
    for (int i = 0; i < 3; ++i)
        levels[i] = int(srgb_encode(glm::clamp(linear[i], 0.0f, 1.0f)) * color_levels + 0.5f);
    return levels;
}

// One texture for each color that occurs; returns each vertex's.
std::vector<std::size_t> add_vertex_colors(Export& out, const Mesh& mesh, const Material& material,
                                           const std::vector<glm::vec2>& uvs) {
    out.note("vertex colors: rounded, and textures below them read at the vertices only");
    std::map<std::array<int, 3>, std::size_t> known;
    std::vector<std::size_t> textures(mesh.positions.size());
    std::string list;
    for (std::size_t v = 0; v < textures.size(); ++v) {
        const glm::vec4 albedo =
            diffuse_albedo(out.scene, material, uvs.empty() ? glm::vec2(0.0f) : uvs[v], mesh.colors[v]);
        const glm::ivec3 q = quantized(glm::vec3(albedo));
        const auto [place, is_new] = known.try_emplace({q.x, q.y, q.z}, known.size());
        textures[v] = place->second;
        if (!is_new) continue;
        glm::vec3 color;
        for (int i = 0; i < 3; ++i) color[i] = srgb_decode(float(q[i]) / color_levels);
        list += fmt::format(", texture {{ {} }}\n", texture_of(out, material, color));
    }
    out.add("texture_list {{ {}{} }}\n", known.size(), list);
    return textures;
}

} // namespace

void declare_mesh(Export& out, std::size_t index) {
    const Mesh& mesh = out.scene.meshes[index];
    const Material& material = out.scene.materials[std::size_t(mesh.material)];
    out.add("#declare M{} = mesh2 {{\nvertex_vectors {{ {}", index, mesh.positions.size());
    for (const glm::vec3& p : mesh.positions) out.add(",{}", vector(p));
    out.add(" }}\nnormal_vectors {{ {}", mesh.normals.size());
    for (const glm::vec3& n : mesh.normals) out.add(",{}", vector(n));
    out.add(" }}\n");

    // POV-Ray counts rows of an image from below.
    const std::vector<glm::vec2> uvs = texture_coordinates(mesh, material);
    if (!uvs.empty()) {
        out.add("uv_vectors {{ {}", uvs.size());
        for (const glm::vec2& uv : uvs) out.add(",<{:.7g},{:.7g}>", uv.x, 1.0f - uv.y);
        out.add(" }}\n");
    }
    std::vector<std::size_t> colors;
    if (!mesh.colors.empty()) colors = add_vertex_colors(out, mesh, material, uvs);

    out.add("face_indices {{ {}", mesh.indices.size() / 3);
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const std::uint32_t a = mesh.indices[i], b = mesh.indices[i + 1], c = mesh.indices[i + 2];
        out.add(",<{},{},{}>", a, b, c);
        if (!colors.empty()) out.add(",{},{},{}", colors[a], colors[b], colors[c]);
    }
    out.add(" }}\n}}\n");
}

} // namespace luxel::povray
