// SPDX-License-Identifier: MIT
// Accessors as vectors of floats or indices: every offset, stride, count and type is checked before memory is
// taken.
#pragma once
#include <cmath>
#include <vector>

#include "scene/gltf/document.h"

namespace luxel::gltf {

// Number of elements, read from the JSON alone.
std::uint64_t accessor_count(const Document& document, const Value& reference);

// Vectors of 2, 3 or 4 floats; normalized integers become [0, 1] or [-1, 1], other integers their value
// (which KHR_mesh_quantization allows). Numbers of damaged files may be infinite or no numbers.
// `allow_vec3_as_vec4`: a missing w becomes 1.
std::vector<glm::vec2> read_vec2(Document& document, const Value& reference);
std::vector<glm::vec3> read_vec3(Document& document, const Value& reference);
std::vector<glm::vec4> read_vec4(Document& document, const Value& reference, bool allow_vec3_as_vec4 = false);
std::vector<glm::mat4> read_mat4(Document& document, const Value& reference); // floats

template <int N> bool is_finite(const glm::vec<N, float>& v) {
    for (int i = 0; i < N; ++i)
        if (!std::isfinite(v[i])) return false;
    return true;
}

// Unsigned integers; not yet compared with a vertex count.
std::vector<std::uint32_t> read_indices(Document& document, const Value& reference);

} // namespace luxel::gltf
