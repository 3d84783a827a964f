// SPDX-License-Identifier: MIT
// EXT_meshopt_compression: a buffer view as the meshoptimizer codec stored it. The decoder is safe on any
// input but may return garbage: indices and numbers are checked by those who use them.
#pragma once
#include <cstdint>
#include <span>

#include "scene/gltf/json.h"

namespace luxel::gltf {

enum class MeshoptMode { attributes, triangles, indices };
enum class MeshoptFilter { none, octahedral, quaternion, exponential };

struct MeshoptStream {
    std::span<const std::uint8_t> source;
    std::uint64_t count = 0, stride = 0;
    MeshoptMode mode = MeshoptMode::attributes;
    MeshoptFilter filter = MeshoptFilter::none;
};

// Error Fault::bad_input: a stride the codec does not know, or more elements than so few bytes can hold.
MeshoptStream describe_meshopt(const Value& extension, std::span<const std::uint8_t> source);
// target.size() == count * stride
void decode_meshopt(const Value& extension, const MeshoptStream& stream, std::span<std::uint8_t> target);

} // namespace luxel::gltf
