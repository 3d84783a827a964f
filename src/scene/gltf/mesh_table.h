// SPDX-License-Identifier: MIT
// Meshes read on first use, shared by the instances that show them.
#pragma once
#include <map>
#include <tuple>
#include <vector>

#include "scene/gltf/deform.h"
#include "scene/gltf/document.h"
#include "scene/gltf/transform.h"
#include "scene/scene.h"

namespace luxel::gltf {

// Instances that a scene may have; one file can multiply nodes with primitives.
inline constexpr std::size_t max_instances = std::size_t(1) << 22;

class MeshTable {
public:
    MeshTable(Document& document, Scene& scene, SkinTable& skins)
        : document_(document), scene_(scene), skins_(skins) {}

    // One instance for each primitive of the node's mesh, the transform still to be set. A mirroring
    // transform stays one: front faces are those that are counter-clockwise in object space. Skins and morph
    // weights are applied; the place of a node with a skin has no say, as its joints have.
    void add_instances(const Value& node, const Place& place);

    // Of the scene's instances, by index.
    const std::vector<glm::dmat4>& transforms() const { return transforms_; }

private:
    // A mesh, its skin (or npos), its weights: what differs in one of them has different vertices.
    using Key = std::tuple<std::size_t, std::size_t, std::vector<float>>;
    struct Part {
        int mesh; // index into Scene::meshes
        glm::dvec3 middle;
        bool skinned;
    };
    const std::vector<Part>& parts(const Value& node);
    std::vector<Part> read_parts(const Value& json, const Key& key);

    Document& document_;
    Scene& scene_;
    SkinTable& skins_;
    std::map<Key, std::vector<Part>> known_;
    std::vector<glm::dmat4> transforms_;
};

} // namespace luxel::gltf
