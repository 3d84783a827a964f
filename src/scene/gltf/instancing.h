// SPDX-License-Identifier: MIT
// EXT_mesh_gpu_instancing: one node that shows its mesh at many places.
#pragma once
#include <vector>

#include "scene/gltf/document.h"
#include "scene/gltf/transform.h"

namespace luxel::gltf {

// The places of the instances, below that of the node. Those that are not finite are left out with a warning.
std::vector<Place> read_instances(Document& document, const Value& extension, const Place& node);

} // namespace luxel::gltf
