// SPDX-License-Identifier: MIT
// Meshes read on first use, shared by the instances that show them.
#pragma once
#include <array>
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

    // One instance for each primitive of the node's mesh. Front faces are counter-clockwise in world space: a
    // transform of negative determinant gets a mirrored copy of the mesh.
    void add_instances(const Value& node, const glm::mat4& world);

private:
    // Index into Scene::meshes as it is and mirrored; -1: not read yet.
    struct Primitive {
        std::array<int, 2> mesh{-1, -1};
    };
    std::vector<Primitive>& primitives(const Value& reference, bool mirrored);
    void read_primitives(const Value& json, bool mirrored, std::vector<Primitive>& read);
    int mesh(Primitive& primitive, bool mirrored);

    Document& document_;
    Scene& scene_;
    std::map<std::size_t, std::vector<Primitive>> known_;
};

} // namespace luxel::gltf
