// SPDX-License-Identifier: MIT
// One primitive of a glTF mesh as a Mesh.
#pragma once
#include <optional>
#include <span>

#include "scene/gltf/deform.h"
#include "scene/gltf/document.h"
#include "scene/scene.h"

namespace luxel::gltf {

// What is done to a mesh's vertices before they are shown.
struct Deformation {
    std::span<const float> weights; // of its morph targets; empty = none
    const Joints* joints = nullptr;
};

struct Primitive {
    Mesh mesh;
    glm::dvec3 middle{0.0}; // to be added to its positions
    bool skinned = false;   // they are world space
};

// nullopt: points or lines, or no triangle at all (counted as a warning). `materials` must hold the material.
std::optional<Primitive> read_primitive(Document& document, const Value& primitive, const Scene& scene,
                                        int default_material, const Deformation& deformation);

} // namespace luxel::gltf
