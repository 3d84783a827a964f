// SPDX-License-Identifier: MIT
// Normals that an OBJ file says only by its smoothing groups.
#pragma once

namespace tinyobj {
struct attrib_t;
struct shape_t;
} // namespace tinyobj

#include <vector>

namespace luxel {

// Gives every corner without a normal one: in a smoothing group the mean of the
// group's faces around the vertex, by their angles there [Thurmer1998]; without
// a group (s off) that of its face. Indices out of range are left to whoever
// reads the corners.
void add_missing_normals(tinyobj::attrib_t& attributes, std::vector<tinyobj::shape_t>& shapes);

} // namespace luxel
