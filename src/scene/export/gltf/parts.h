// SPDX-License-Identifier: MIT
// The parts of a glTF file. What they use of extensions is put down in `extensions`.
#pragma once
#include <set>
#include <string>

#include "scene/export/gltf/buffer.h"
#include "scene/export/output.h"

namespace luxel::gltf_export {

struct Export : ExportOutput {
    using ExportOutput::ExportOutput;
    Json json;
    Buffer buffer;
    std::set<std::string> extensions;
};

// The least power of two, from 1, that no part of `color` exceeds, as a factor on a color in [0, 1]: the
// product of both is `color` again to the bit.
float power_of_two_over(glm::vec3 color);

void add_textures(Export& out);
void add_materials(Export& out);
void add_meshes(Export& out);
// Instances, lights and cameras, in this order.
void add_nodes(Export& out, const ExportedView& view);

Json to_json(glm::vec3 v);

} // namespace luxel::gltf_export
