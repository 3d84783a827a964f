// SPDX-License-Identifier: MIT
#include "scene/gltf/gltf.h"

#include "scene/gltf/document.h"
#include "scene/gltf/extensions.h"
#include "scene/gltf/material.h"
#include "scene/gltf/nodes.h"
#include "scene/validate.h"

namespace luxel {

Scene load_gltf(const std::filesystem::path& path, const LoadOptions& options) {
    gltf::Document document(path);
    gltf::check_version_and_extensions(document);

    Scene scene;
    scene.name = path.stem().string();
    gltf::read_materials(document, scene, options);
    gltf::read_nodes(document, scene, options);
    scene.warnings = document.warnings();
    validate_scene(scene, document.name());
    return scene;
}

} // namespace luxel
