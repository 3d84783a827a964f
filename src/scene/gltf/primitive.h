// SPDX-License-Identifier: MIT
// One primitive of a glTF mesh as a Mesh.
#pragma once
#include <optional>

#include "scene/gltf/document.h"
#include "scene/scene.h"

namespace luxel::gltf {

// nullopt: points or lines, or no triangle at all (counted as a warning). `materials` must hold the material.
std::optional<Mesh> read_primitive(Document& document, const Value& primitive, const Scene& scene,
                                   int default_material);

} // namespace luxel::gltf
