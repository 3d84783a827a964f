// SPDX-License-Identifier: MIT
// Camera scripts: TOML files of [[camera]] tables, the same as in scene files, for use with any scene.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "scene/scene.h"
#include "scene/scene_file_section.h"

namespace luxel {

// One [[camera]] table; `number` names a camera that has no name.
Camera read_camera(Section& section, std::size_t number);

// At least one camera. Errors: Fault::bad_input (with the line), Fault::io.
std::vector<Camera> load_camera_file(const std::filesystem::path& path);

// What load_camera_file reads back, within rounding of the angle; `comment` becomes its first line.
std::string camera_file_text(const std::vector<Camera>& cameras, const std::string& comment);

} // namespace luxel
