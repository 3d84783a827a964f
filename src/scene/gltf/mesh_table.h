// SPDX-License-Identifier: MIT
// Meshes read on first use, shared by the instances that show them.
#pragma once
#include <map>
#include <vector>

#include "scene/gltf/document.h"
#include "scene/scene.h"

namespace luxel::gltf {

// Instances that a scene may have; one file can multiply nodes with primitives.
inline constexpr std::size_t max_instances = std::size_t(1) << 22;

class MeshTable {
public:
    MeshTable(Document& document, Scene& scene) : document_(document), scene_(scene) {}

    // One instance for each primitive of the node's mesh. A mirroring transform stays one: front faces are
    // those that are counter-clockwise in object space.
    void add_instances(const Value& node, const glm::mat4& world);

private:
    // Indices into Scene::meshes.
    const std::vector<int>& primitives(const Value& reference);
    std::vector<int> read_primitives(const Value& json);

    Document& document_;
    Scene& scene_;
    std::map<std::size_t, std::vector<int>> known_;
};

} // namespace luxel::gltf
