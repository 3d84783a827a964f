// SPDX-License-Identifier: MIT
#include "scene/gltf/document.h"

#include <cstring>

#include <nlohmann/json.hpp>

#include "scene/gltf/meshopt.h"
#include "scene/gltf/uri.h"

namespace luxel::gltf {
namespace {

constexpr std::uint32_t glb_magic = 0x46546c67;  // "glTF"
constexpr std::uint32_t json_chunk = 0x4e4f534a; // "JSON"
constexpr std::uint32_t bin_chunk = 0x004e4942;  // "BIN\0"

std::uint32_t read_u32(std::span<const std::uint8_t> bytes, std::size_t offset) {
    std::uint32_t value;
    std::memcpy(&value, bytes.data() + offset, sizeof value);
    return value;
}

} // namespace

Container split_container(std::span<const std::uint8_t> file, const std::string& name) {
    if (file.empty()) fail(Fault::bad_input, "{}: the file is empty", name);
    if (file.size() < 4 || read_u32(file, 0) != glb_magic) return {file, std::nullopt};

    // Header: magic, version, length of the whole.
    if (file.size() < 12) fail(Fault::bad_input, "{}: GLB header: the file is truncated", name);
    if (read_u32(file, 4) != 2)
        fail(Fault::bad_input, "{}: GLB header: version {} is not 2", name, read_u32(file, 4));
    const std::size_t length = read_u32(file, 8);
    if (length > file.size())
        fail(Fault::bad_input, "{}: GLB header: the file is truncated ({} of {} bytes)", name, file.size(),
             length);
    if (length < 12) fail(Fault::bad_input, "{}: GLB header: length {} is too small", name, length);
    file = file.first(length);

    // Chunks: JSON first, then at most one BIN; others are to be ignored.
    Container parts;
    for (std::size_t at = 12; at < file.size();) {
        if (file.size() - at < 8) fail(Fault::bad_input, "{}: GLB chunk at byte {}: truncated", name, at);
        const std::size_t size = read_u32(file, at);
        const std::uint32_t type = read_u32(file, at + 4);
        if (size > file.size() - at - 8)
            fail(Fault::bad_input, "{}: GLB chunk at byte {}: its {} bytes do not fit the file", name, at,
                 size);
        const auto content = file.subspan(at + 8, size);
        if (at == 12 && type != json_chunk)
            fail(Fault::bad_input, "{}: GLB: the first chunk is not JSON", name);
        if (at == 12) parts.json = content;
        if (type == bin_chunk && !parts.binary) parts.binary = content;
        at += 8 + size;
    }
    if (parts.json.empty()) fail(Fault::bad_input, "{}: GLB: there is no JSON chunk", name);
    return parts;
}

Document::Document(const std::filesystem::path& path)
    : name_(printable(path.string(), longest_path)),
      folder_(path.has_parent_path() ? path.parent_path() : "."), file_(luxel::read_file(path)) {
    const Container parts = split_container(file_, name_);
    binary_ = parts.binary;
    json_ = parse_json(parts.json, name_);
}

Value Document::resolve(const char* array, const Value& reference) const {
    const Value all = root()[array];
    return all.at(reference.index(all.size(), array));
}

void Document::charge(std::uint64_t count, std::uint64_t bytes_each) {
    if (bytes_each != 0 && count > budget_ / bytes_each)
        fail(Fault::resource, "{}: the scene needs more than {} GiB of memory", name_, max_scene_bytes >> 30);
    budget_ -= count * bytes_each;
}

std::vector<std::string> Document::warnings() const {
    std::vector<std::string> sentences;
    for (const auto& [sentence, count] : warnings_)
        sentences.push_back(count == 1 ? fmt::format("{}: {}", name_, sentence)
                                       : fmt::format("{}: {} ({} times)", name_, sentence, count));
    return sentences;
}

std::span<const std::uint8_t> Document::read_buffer(const Value& buffer, std::size_t index) {
    const std::uint64_t length = buffer["byteLength"].integer();
    const Value uri = buffer["uri"];
    std::span<const std::uint8_t> bytes;
    if (uri) {
        // Only what the file on disk holds is read; a byteLength beyond it is found out after.
        auto content = read_uri(folder_, uri, std::min(budget_, std::uint64_t(2) << 30));
        if (!content) fail(Fault::io, "{}: {}: cannot open \"{}\"", name_, uri.place(), uri_name(uri.text()));
        charge(content->size(), 1);
        bytes = buffers_[index] = std::move(*content);
    } else if (index == 0 && binary_) {
        bytes = *binary_;
    } else {
        buffer.fail("has no uri and the file has no binary chunk for it");
    }
    if (length > bytes.size()) buffer.fail("holds {} bytes instead of {}", bytes.size(), length);
    return bytes.first(std::size_t(length));
}

std::span<const std::uint8_t> Document::buffer(const Value& reference) {
    const Value all = root()["buffers"];
    const std::size_t index = reference.index(all.size(), "buffer");
    const Value value = all.at(index);
    if (const auto known = buffers_.find(index); known != buffers_.end()) {
        const std::uint64_t length = value["byteLength"].integer();
        return std::span<const std::uint8_t>(known->second).first(std::size_t(length));
    }
    return read_buffer(value, index);
}

std::span<const std::uint8_t> Document::slice(const Value& view) {
    const auto bytes = buffer(view["buffer"]);
    const std::uint64_t offset = view["byteOffset"].integer(0), length = view["byteLength"].integer();
    if (offset > bytes.size() || length > bytes.size() - offset)
        view.fail("bytes {} + {} lie outside the buffer of {}", offset, length, bytes.size());
    return bytes.subspan(std::size_t(offset), std::size_t(length));
}

Document::View Document::buffer_view(const Value& reference) {
    const Value all = root()["bufferViews"];
    const std::size_t index = reference.index(all.size(), "bufferView");
    const Value view = all.at(index);
    if (const Value compressed = view["extensions"]["EXT_meshopt_compression"])
        return decompress(compressed, view["byteLength"].integer(), index);
    return {slice(view), view["byteStride"].integer(0)};
}

Document::View Document::decompress(const Value& compressed, std::uint64_t declared_bytes,
                                    std::size_t index) {
    const std::uint64_t stride = compressed["byteStride"].integer();
    if (const auto known = decompressed_.find(index); known != decompressed_.end())
        return {known->second, stride};

    // The size is checked against what the codec can produce from so many bytes, then charged, then taken.
    const auto source = slice(compressed);
    const MeshoptStream stream = describe_meshopt(compressed, source);
    if (stream.count > declared_bytes / stream.stride || stream.count * stream.stride != declared_bytes)
        compressed.fail("{} elements of {} bytes are not the view's {} bytes", stream.count, stream.stride,
                        declared_bytes);
    charge(declared_bytes, 1);
    auto& bytes = decompressed_[index];
    bytes.resize(std::size_t(declared_bytes));
    decode_meshopt(compressed, stream, bytes);
    return {bytes, stride};
}

} // namespace luxel::gltf
