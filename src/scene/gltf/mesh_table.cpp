// SPDX-License-Identifier: MIT
#include "scene/gltf/mesh_table.h"

#include <algorithm>

#include <glm/gtc/matrix_transform.hpp>

#include "scene/gltf/extensions.h"
#include "scene/gltf/primitive.h"

namespace luxel::gltf {
namespace {

constexpr std::size_t none = ~std::size_t(0);

// The node's, or the mesh's own; none where all are 0.
std::vector<float> weights_of(const Value& node, const Value& mesh) {
    const Value list = node["weights"] ? node["weights"] : mesh["weights"];
    std::vector<float> weights(list.size());
    list.numbers(std::span<float>(weights));
    if (std::all_of(weights.begin(), weights.end(), [](float w) { return w == 0.0f; })) return {};
    return weights;
}

} // namespace

const std::vector<MeshTable::Part>& MeshTable::parts(const Value& node) {
    const Value root = document_.root(), all = root["meshes"];
    const std::size_t index = node["mesh"].index(all.size(), "mesh");
    const std::size_t skin = node["skin"] ? node["skin"].index(root["skins"].size(), "skin") : none;
    const auto [entry, added] = known_.try_emplace(Key{index, skin, weights_of(node, all.at(index))});
    if (added) entry->second = read_parts(all.at(index), entry->first);
    return entry->second;
}

std::vector<MeshTable::Part> MeshTable::read_parts(const Value& json, const Key& key) {
    const Value list = json["primitives"];
    const int default_material = int(scene_.materials.size()) - 1;
    const auto& [index, skin, weights] = key;
    const Deformation deformation{weights, skin == none ? nullptr : &skins_.joints(skin)};
    warn_of_extensions(document_, json, Bearer::mesh);
    std::vector<Part> read;
    for (std::size_t i = 0; i < list.size(); ++i) {
        auto part = read_primitive(document_, list.at(i), scene_, default_material, deformation);
        if (!part) continue;
        part->mesh.name = printable(json["name"].text(""));
        read.push_back({int(scene_.meshes.size()), part->middle, part->skinned});
        scene_.meshes.push_back(std::move(part->mesh));
    }
    return read;
}

void MeshTable::add_instances(const Value& node, const Place& place) {
    const auto placed = solid_transform(place);
    const std::vector<Part>& all = parts(node);
    if (!placed && std::any_of(all.begin(), all.end(), [](const Part& p) { return !p.skinned; }))
        document_.warn("a mesh that is scaled to nothing is left out");
    for (const Part& part : all) {
        if (!placed && !part.skinned) continue;
        if (scene_.instances.size() >= max_instances)
            fail(Fault::resource, "{}: more than {} instances", document_.name(), max_instances);
        Instance& instance = scene_.instances.emplace_back();
        instance.name = printable(node["name"].text(""));
        instance.mesh = part.mesh;
        transforms_.push_back(glm::translate(part.skinned ? glm::dmat4(1.0) : *placed, part.middle));
    }
}

} // namespace luxel::gltf
