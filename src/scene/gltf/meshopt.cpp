// SPDX-License-Identifier: MIT
#include "scene/gltf/meshopt.h"

#include <meshoptimizer.h>

namespace luxel::gltf {
namespace {

MeshoptMode mode_of(const Value& value) {
    const std::string& text = value.text();
    if (text == "ATTRIBUTES") return MeshoptMode::attributes;
    if (text == "TRIANGLES") return MeshoptMode::triangles;
    if (text == "INDICES") return MeshoptMode::indices;
    value.fail("\"{}\" is not a known mode", printable(text));
}

MeshoptFilter filter_of(const Value& value) {
    const std::string text = value.text("NONE");
    if (text == "NONE") return MeshoptFilter::none;
    if (text == "OCTAHEDRAL") return MeshoptFilter::octahedral;
    if (text == "QUATERNION") return MeshoptFilter::quaternion;
    if (text == "EXPONENTIAL") return MeshoptFilter::exponential;
    value.fail("\"{}\" is not a known filter", printable(text));
}

bool stride_fits(const MeshoptStream& s) {
    if (s.mode != MeshoptMode::attributes) return s.stride == 2 || s.stride == 4;
    if (s.stride == 0 || s.stride > 256 || s.stride % 4 != 0) return false;
    if (s.filter == MeshoptFilter::octahedral) return s.stride == 4 || s.stride == 8;
    if (s.filter == MeshoptFilter::quaternion) return s.stride == 8;
    return true;
}

// Fewest bytes that can hold the stream: an index takes a byte, a triangle a byte, and a vertex stream two
// bits of header for each sixteen values of a byte column.
std::uint64_t fewest_bytes(const MeshoptStream& s) {
    if (s.mode == MeshoptMode::indices) return s.count;
    if (s.mode == MeshoptMode::triangles) return s.count / 3;
    return s.count / 64 * s.stride;
}

} // namespace

MeshoptStream describe_meshopt(const Value& extension, std::span<const std::uint8_t> source) {
    MeshoptStream stream;
    stream.source = source;
    stream.count = extension["count"].integer();
    stream.stride = extension["byteStride"].integer();
    stream.mode = mode_of(extension["mode"]);
    stream.filter = filter_of(extension["filter"]);
    if (!stride_fits(stream)) extension.fail("byteStride {} does not fit the mode and filter", stream.stride);
    if (stream.mode != MeshoptMode::attributes && stream.filter != MeshoptFilter::none)
        extension.fail("indices take no filter");
    if (stream.mode == MeshoptMode::triangles && stream.count % 3 != 0)
        extension.fail("count {} is no multiple of 3", stream.count);
    if (stream.count == 0 || stream.count > UINT32_MAX || fewest_bytes(stream) > source.size())
        extension.fail("{} elements cannot come from {} bytes", stream.count, source.size());
    return stream;
}

void decode_meshopt(const Value& extension, const MeshoptStream& stream, std::span<std::uint8_t> target) {
    const auto* from = stream.source.data();
    const std::size_t bytes = stream.source.size(), count = std::size_t(stream.count),
                      stride = std::size_t(stream.stride);
    int failed = 0;
    switch (stream.mode) {
    case MeshoptMode::attributes:
        failed = meshopt_decodeVertexBuffer(target.data(), count, stride, from, bytes);
        break;
    case MeshoptMode::triangles:
        failed = meshopt_decodeIndexBuffer(target.data(), count, stride, from, bytes);
        break;
    case MeshoptMode::indices:
        failed = meshopt_decodeIndexSequence(target.data(), count, stride, from, bytes);
        break;
    }
    if (failed != 0) extension.fail("the compressed data is damaged");

    switch (stream.filter) {
    case MeshoptFilter::none:
        break;
    case MeshoptFilter::octahedral:
        meshopt_decodeFilterOct(target.data(), count, stride);
        break;
    case MeshoptFilter::quaternion:
        meshopt_decodeFilterQuat(target.data(), count, stride);
        break;
    case MeshoptFilter::exponential:
        meshopt_decodeFilterExp(target.data(), count, stride);
        break;
    }
}

} // namespace luxel::gltf
