// SPDX-License-Identifier: MIT
#include "scene/export/geometry.h"

#include <bit>
#include <cstring>
#include <map>

#include "core/file.h"

namespace luxel {
namespace {

void append(std::string& bytes, const void* data, std::size_t size) {
    static_assert(std::endian::native == std::endian::little);
    bytes.append(static_cast<const char*>(data), size);
}

// `world` is given for what mirrors: positions and normals in world space, triangles turned around.
std::string ply(const Mesh& mesh, const Material& material, const glm::mat4* world, bool v_up) {
    const TextureUse* use = leading_texture(material);
    const bool normals = !emits(material), uvs = use && !mesh.texcoords[use->set].empty();
    std::string bytes = fmt::format("ply\nformat binary_little_endian 1.0\nelement vertex {}\n"
                                    "property float x\nproperty float y\nproperty float z\n",
                                    mesh.positions.size());
    if (normals) bytes += "property float nx\nproperty float ny\nproperty float nz\n";
    if (uvs) bytes += "property float u\nproperty float v\n";
    bytes += fmt::format("element face {}\nproperty list uchar int vertex_indices\nend_header\n",
                         mesh.indices.size() / 3);

    const glm::mat3 to_normals = world ? glm::transpose(glm::inverse(glm::mat3(*world))) : glm::mat3(1.0f);
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const glm::vec3 p =
            world ? glm::vec3(*world * glm::vec4(mesh.positions[i], 1.0f)) : mesh.positions[i];
        append(bytes, &p, sizeof p);
        const glm::vec3 n = world ? glm::normalize(to_normals * mesh.normals[i]) : mesh.normals[i];
        if (normals) append(bytes, &n, sizeof n);
        if (!uvs) continue;
        glm::vec2 uv = glm::vec2(use->transform * glm::vec3(mesh.texcoords[use->set][i], 1.0f));
        if (v_up) uv.y = 1.0f - uv.y;
        append(bytes, &uv, sizeof uv);
    }
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        std::uint32_t corners[] = {mesh.indices[i], mesh.indices[i + 1], mesh.indices[i + 2]};
        if (world) std::swap(corners[1], corners[2]);
        bytes += char(3);
        append(bytes, corners, sizeof corners);
    }
    return bytes;
}

} // namespace

const TextureUse* leading_texture(const Material& m) {
    for (const TextureUse* use :
         {&m.base_color_texture, &m.emission_texture, &m.normal_texture, &m.metallic_roughness_texture,
          &m.transmission_texture, &m.specular_texture, &m.specular_color_texture})
        if (use->texture >= 0) return use;
    return nullptr;
}

std::vector<ExportedShape> write_shapes(ExportOutput& out, bool v_up) {
    std::map<int, std::string> written; // by mesh
    std::vector<ExportedShape> shapes;
    for (std::size_t i = 0; i < out.scene.instances.size(); ++i) {
        const Instance& instance = out.scene.instances[i];
        const Mesh& mesh = out.scene.meshes[std::size_t(instance.mesh)];
        const Material& material = out.scene.materials[std::size_t(mesh.material)];
        if (!mesh.colors.empty()) out.note("vertex colors: their mean");
        const bool mirrored = glm::determinant(glm::mat3(instance.transform)) < 0.0f;
        ExportedShape shape{&instance, &material, std::size_t(mesh.material), "", instance.transform};
        std::string& known = mirrored ? shape.file : written[instance.mesh];
        if (known.empty()) {
            known = mirrored ? fmt::format("{}-instance-{}.ply", out.stem, i)
                             : fmt::format("{}-mesh-{}.ply", out.stem, instance.mesh);
            write_file(out.folder / known,
                       std::string_view(ply(mesh, material, mirrored ? &instance.transform : nullptr, v_up)));
        }
        if (mirrored) shape.transform = glm::mat4(1.0f);
        shape.file = known;
        shapes.push_back(std::move(shape));
    }
    return shapes;
}

} // namespace luxel
