// SPDX-License-Identifier: MIT
// Export to glTF 2.0: the scene as a whole, so that reading it gives the same again; see docs/export.md.
#pragma once
#include "scene/export/output.h"

namespace luxel {

// .glb, or .gltf with STEM.bin beside it; pictures are in the buffer. `view` comes first among the cameras,
// unless it is one of the scene's. Returns what is lost, one counted sentence each; the same stands in the
// file's asset.extras. Error Fault::io.
std::vector<std::string> write_gltf(const std::filesystem::path& file, const Scene& scene,
                                    const ExportedView& view);

} // namespace luxel
