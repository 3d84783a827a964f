// SPDX-License-Identifier: MIT
// Places of nodes, in double precision: a node far from the origin may have children of millimeters.
#pragma once
#include <optional>

#include "scene/gltf/json.h"

namespace luxel::gltf {

// A node's place in the world.
struct Place {
    glm::dmat4 transform{1.0};
    // 1, or -1 where front and back change sides. A scale of 0 counts as a small positive one, so that
    // flattened objects know their sides, too.
    double side = 1.0;

    Place operator*(const Place& child) const { return {transform * child.transform, side * child.side}; }
};

Place trs(const glm::dvec3& translation, const glm::dvec4& rotation, const glm::dvec3& scale);

// By the node's "matrix", or its translation, rotation and scale.
Place local_place(const Value& node);

// What a mesh is drawn with: a transform that flattens it gets a millionth of thickness, so that it can be
// inverted and its normals survive. nullopt: no area is left, or the numbers are not finite.
std::optional<glm::dmat4> solid_transform(const Place& place);

// Transposed inverse times determinant, which exists for singular matrices, too: takes normals along.
glm::dmat3 cofactors(const glm::dmat3& m);

} // namespace luxel::gltf
