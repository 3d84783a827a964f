// SPDX-License-Identifier: MIT
// Materials and the textures they use.
#pragma once
#include "scene/gltf/document.h"
#include "scene/load.h"
#include "scene/scene.h"

namespace luxel::gltf {

// Fills scene.materials, with glTF's default material appended as the last one, and scene.textures (decoded
// in parallel). A texture that cannot be had is a warning and a grey one, or an error with options.strict.
void read_materials(Document& document, Scene& scene, const LoadOptions& options);

} // namespace luxel::gltf
