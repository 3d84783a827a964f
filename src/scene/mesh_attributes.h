// SPDX-License-Identifier: MIT
// What a mesh needs and its file may lack: normals, tangents, front faces; vertices that nothing uses are
// dropped.
#pragma once
#include "scene/scene.h"

namespace luxel {

// One normal per face: vertices are no longer shared between triangles. Needs valid indices.
void make_flat(Mesh& mesh);

// Makes normals unit length; those of no length become the mean of the faces around their vertex, by area.
void repair_normals(Mesh& mesh);

// Per-vertex tangents along +u of the given texcoord set, accumulated by area over the faces and made
// orthogonal to the normal. Not MikkTSpace exactly: vertices are not split where the handedness changes, and
// angles do not weigh.
void make_tangents(Mesh& mesh, int set, const glm::mat3& uv_transform);

// Keeps the vertices that indices refer to, in the order of their first use.
void drop_unused_vertices(Mesh& mesh);

} // namespace luxel
