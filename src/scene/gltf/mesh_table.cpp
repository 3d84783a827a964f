// SPDX-License-Identifier: MIT
#include "scene/gltf/mesh_table.h"

#include <cmath>

#include "scene/gltf/primitive.h"

namespace luxel::gltf {

const std::vector<int>& MeshTable::primitives(const Value& reference) {
    const Value all = document_.root()["meshes"];
    const std::size_t index = reference.index(all.size(), "mesh");
    const auto [entry, added] = known_.try_emplace(index);
    if (added) entry->second = read_primitives(all.at(index));
    return entry->second;
}

std::vector<int> MeshTable::read_primitives(const Value& json) {
    const Value list = json["primitives"];
    const int default_material = int(scene_.materials.size()) - 1;
    std::vector<int> read;
    for (std::size_t i = 0; i < list.size(); ++i) {
        if (list.at(i)["targets"].size() > 0) document_.warn("morph targets are not applied");
        auto mesh = read_primitive(document_, list.at(i), scene_, default_material);
        if (!mesh) continue;
        mesh->name = printable(json["name"].text(""));
        read.push_back(int(scene_.meshes.size()));
        scene_.meshes.push_back(std::move(*mesh));
    }
    return read;
}

void MeshTable::add_instances(const Value& node, const glm::mat4& world) {
    const double determinant = glm::determinant(glm::dmat3(world));
    if (determinant == 0.0 || !std::isfinite(determinant))
        return document_.warn("a mesh that is scaled to nothing is left out");
    for (const int mesh : primitives(node["mesh"])) {
        if (scene_.instances.size() >= max_instances)
            fail(Fault::resource, "{}: more than {} instances", document_.name(), max_instances);
        scene_.instances.push_back({printable(node["name"].text("")), mesh, world, ""});
    }
}

} // namespace luxel::gltf
