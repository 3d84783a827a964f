// SPDX-License-Identifier: MIT
// glTF 2.0 (.gltf with data: URIs or files beneath its folder, .glb) to a Scene; what is read is in
// docs/scenes.md.
#pragma once
#include <filesystem>

#include "scene/load.h"
#include "scene/scene.h"

namespace luxel {

// A valid scene, but for cameras and lights, of which it has only those of the file. Errors:
// Fault::bad_input, Fault::io, Fault::resource, Fault::unsupported (an extension the file requires).
Scene load_gltf(const std::filesystem::path& path, const LoadOptions& options = {});

} // namespace luxel
