// SPDX-License-Identifier: MIT
// Morph targets and skins at rest: what the vertices of a mesh are before anything is animated.
#pragma once
#include <map>
#include <span>
#include <vector>

#include "scene/gltf/document.h"
#include "scene/scene.h"

namespace luxel::gltf {

// Joint matrices times inverse bind matrices, to world space.
using Joints = std::vector<glm::dmat4>;

// `world`: of all nodes that the scene reaches; joints of others stand where they are within their own tree.
class SkinTable {
public:
    SkinTable(Document& document, const std::vector<glm::dmat4>& world)
        : document_(document), world_(world) {}
    const Joints& joints(std::size_t skin);

private:
    Document& document_;
    const std::vector<glm::dmat4>& world_;
    std::map<std::size_t, Joints> known_;
};

// Adds the primitive's targets by `weights`, one for each. Positions are read by now, and other attributes
// that the primitive has.
void morph(Document& document, const Value& primitive, std::span<const float> weights, Mesh& mesh);

// Moves the vertices with the joints; false where the primitive has no JOINTS_0 and WEIGHTS_0. Positions are
// world space then, less `offset`, which keeps them precise.
bool apply_skin(Document& document, const Value& primitive, const Joints& joints, Mesh& mesh,
                glm::dvec3& offset);

} // namespace luxel::gltf
