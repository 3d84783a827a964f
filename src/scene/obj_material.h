// SPDX-License-Identifier: MIT
// MTL materials in terms of the scene's.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "core/file.h"
#include "scene/load.h"
#include "scene/obj_statements.h"
#include "scene/scene.h"

namespace tinyobj {
struct material_t;
}

namespace luxel {

// Fills scene.materials (a grey Lambertian one is appended for faces without)
// and scene.textures.
void read_obj_materials(Scene& scene, const std::vector<tinyobj::material_t>& materials,
                        const MtlStatements& statements, LeftOut& left_out, const Folder& folder,
                        const std::string& source_name, const LoadOptions& options);

// A path as OBJ and MTL write it: backslashes are separators.
std::string obj_path(std::string_view path);

} // namespace luxel
