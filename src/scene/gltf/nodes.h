// SPDX-License-Identifier: MIT
// The node tree: instances of meshes, cameras and lights in world space.
#pragma once
#include "scene/gltf/document.h"
#include "scene/load.h"
#include "scene/scene.h"

namespace luxel::gltf {

// Appends to meshes, instances, cameras and lights, and sets the scene's origin. Needs scene.materials (the
// default one last).
void read_nodes(Document& document, Scene& scene, const LoadOptions& options);

} // namespace luxel::gltf
