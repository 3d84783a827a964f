// SPDX-License-Identifier: MIT
// What a mesh needs and its file may lack: normals, tangents, front faces; vertices that nothing uses are
// dropped.
#pragma once
#include "scene/scene.h"

namespace luxel {

// One normal per face: vertices are no longer shared between triangles. Needs valid indices.
void make_flat(Mesh& mesh);

// Of length 1, `v` not of length 0. What is so to the rounding of floats stays as it is: a scene that was
// written and is read again is the same to the bit.
glm::vec3 as_unit(glm::vec3 v);

// Makes normals unit length; those of no length or not finite become the mean of the faces around their
// vertex, by area, and are counted.
int repair_normals(Mesh& mesh);

// Takes out triangles that have a position that is not finite, and counts them. (Triangles without area stay:
// nothing ever meets them.)
int drop_bad_triangles(Mesh& mesh);

// Per-vertex tangents along +u of the given texcoord set, by the rules of MikkTSpace, which glTF names: the
// faces around a vertex count by their angles; those whose texture is mirrored, and those that share no edge,
// do not mix, for which shared vertices are split; vertices that are equal in position, normal and texture
// coordinates are one.
void make_tangents(Mesh& mesh, int set, const glm::mat3& uv_transform);
inline constexpr std::size_t tangent_bytes_per_corner =
    160; // most memory that it takes, split vertices included

// The vertices order[0], order[1], ... of the mesh become its vertices; indices are as they were.
void gather_vertices(Mesh& mesh, const std::vector<std::uint32_t>& order);

// Keeps the vertices that indices refer to, in the order of their first use.
void drop_unused_vertices(Mesh& mesh);

} // namespace luxel
