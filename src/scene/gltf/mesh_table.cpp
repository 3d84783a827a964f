// SPDX-License-Identifier: MIT
#include "scene/gltf/mesh_table.h"

#include <cmath>

#include "scene/gltf/primitive.h"
#include "scene/mesh_attributes.h"

namespace luxel::gltf {
namespace {

std::uint64_t bytes_of(const Mesh& mesh) {
    const auto bytes = [](const auto& v) { return std::uint64_t(v.size()) * sizeof(v[0]); };
    return bytes(mesh.positions) + bytes(mesh.normals) + bytes(mesh.tangents) + bytes(mesh.texcoords[0]) +
           bytes(mesh.texcoords[1]) + bytes(mesh.colors) + bytes(mesh.indices);
}

} // namespace

std::vector<MeshTable::Primitive>& MeshTable::primitives(const Value& reference, bool mirrored) {
    const Value all = document_.root()["meshes"];
    const std::size_t index = reference.index(all.size(), "mesh");
    const auto [entry, added] = known_.try_emplace(index);
    if (added) read_primitives(all.at(index), mirrored, entry->second);
    return entry->second;
}

void MeshTable::read_primitives(const Value& json, bool mirrored, std::vector<Primitive>& read) {
    const Value list = json["primitives"];
    const int default_material = int(scene_.materials.size()) - 1;
    for (std::size_t i = 0; i < list.size(); ++i) {
        if (list.at(i)["targets"].size() > 0) document_.warn("morph targets are not applied");
        auto mesh = read_primitive(document_, list.at(i), scene_, default_material);
        if (!mesh) continue;
        mesh->name = printable(json["name"].text(""));
        if (mirrored) mirror(*mesh);
        read.emplace_back().mesh[mirrored ? 1 : 0] = int(scene_.meshes.size());
        scene_.meshes.push_back(std::move(*mesh));
    }
}

int MeshTable::mesh(Primitive& primitive, bool mirrored) {
    int& wanted = primitive.mesh[mirrored ? 1 : 0];
    if (wanted >= 0) return wanted;
    const Mesh& source = scene_.meshes[std::size_t(primitive.mesh[mirrored ? 0 : 1])];
    document_.charge(bytes_of(source), 1);
    Mesh copy = source;
    mirror(copy);
    wanted = int(scene_.meshes.size());
    scene_.meshes.push_back(std::move(copy));
    return wanted;
}

void MeshTable::add_instances(const Value& node, const glm::mat4& world) {
    const double determinant = glm::determinant(glm::dmat3(world));
    if (determinant == 0.0 || !std::isfinite(determinant))
        return document_.warn("a mesh that is scaled to nothing is left out");
    const bool mirrored = determinant < 0.0;
    for (Primitive& primitive : primitives(node["mesh"], mirrored)) {
        if (scene_.instances.size() >= max_instances)
            fail(Fault::resource, "{}: more than {} instances", document_.name(), max_instances);
        Instance instance;
        instance.name = printable(node["name"].text(""));
        instance.mesh = mesh(primitive, mirrored);
        instance.transform = world;
        scene_.instances.push_back(std::move(instance));
    }
}

} // namespace luxel::gltf
