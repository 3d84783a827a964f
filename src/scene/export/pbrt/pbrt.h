// SPDX-License-Identifier: MIT
// Export to pbrt-v4; see docs/export.md.
#pragma once
#include "scene/export/output.h"

namespace luxel {

// The scene and, beside it, its meshes (PLY), pictures and sky. Returns what is only approximated, one
// counted sentence each; the same stands in the file as comments. Error Fault::io.
std::vector<std::string> write_pbrt(const std::filesystem::path& file, const Scene& scene,
                                    const ExportedView& view);

} // namespace luxel
