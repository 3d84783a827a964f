// SPDX-License-Identifier: MIT
// Scene files: TOML that wraps geometry and adds lights, cameras, an environment and roles; see
// docs/scene-file.md.
#pragma once
#include <filesystem>

#include "scene/load.h"
#include "scene/scene.h"

namespace luxel {

// Not completed by defaults: load_scene does that. Errors: Fault::bad_input (with the line), Fault::io.
Scene load_scene_file(const std::filesystem::path& path, const LoadOptions& options = {});

// Whether `name` matches a pattern of literal characters, * (any number of them) and ? (any one).
bool matches_glob(std::string_view pattern, std::string_view name);

} // namespace luxel
