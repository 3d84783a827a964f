// SPDX-License-Identifier: MIT
// Meshes as PLY files, which pbrt and Mitsuba both read.
#pragma once
#include <string>
#include <vector>

#include "scene/export/output.h"

namespace luxel {

// The texture whose coordinates a mesh of this material is written with: its first. nullptr: it has none.
const TextureUse* leading_texture(const Material& material);

// What of an instance a renderer reads.
struct ExportedShape {
    const Instance* instance;
    const Material* material;
    std::size_t material_index;
    std::string file;          // PLY, beside the scene
    glm::mat4 transform{1.0f}; // of that file to the world
};

// One file a mesh, with texture coordinates of its leading texture, transformed. Mirrored instances get one
// of their own in world space, wound so that the front stays the front: renderers differ in what they make of
// a mirroring transform. Normals are left out of emitters: the side that emits is then that of the winding
// alone. v_up: v grows from the lowest row of an image to its top. Error Fault::io.
std::vector<ExportedShape> write_shapes(ExportOutput& out, bool v_up);

} // namespace luxel
