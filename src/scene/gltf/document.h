// SPDX-License-Identifier: MIT
// A glTF file opened: its JSON, its buffers (read on first use), and a budget that all memory is charged to.
#pragma once
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/file.h"
#include "scene/gltf/json.h"

namespace luxel::gltf {

// Bytes that one file may take once decoded; a small file can ask for a lot (shared accessors, sparse ones).
inline constexpr std::uint64_t max_scene_bytes = std::uint64_t(8) << 30;

// The two parts of a file: JSON, and the binary chunk of a .glb.
struct Container {
    std::span<const std::uint8_t> json;
    std::optional<std::span<const std::uint8_t>> binary;
};
// By content: .glb when it starts with "glTF", otherwise JSON.
Container split_container(std::span<const std::uint8_t> file, const std::string& name);

class Document {
public:
    explicit Document(const std::filesystem::path& path);
    Document(const Document&) = delete;
    Document& operator=(const Document&) = delete;

    const std::string& name() const { return name_; }
    const Folder& folder() const { return folder_; }
    Value root() const { return {json_.get(), "", &name_}; }

    // Element `reference` (an index) of the root's array.
    Value resolve(const char* array, const Value& reference) const;

    // The bytes of bufferViews[reference], decompressed if need be; they live as long as the document.
    struct View {
        std::span<const std::uint8_t> bytes;
        std::uint64_t stride; // 0 = tightly packed
    };
    View buffer_view(const Value& reference);

    // Takes count * bytes_each from the budget before it is allocated. Error Fault::resource.
    void charge(std::uint64_t count, std::uint64_t bytes_each);

    // Equal sentences are counted, not repeated.
    void warn(const std::string& sentence, int count = 1) { warnings_[sentence] += count; }
    std::vector<std::string> warnings() const;

private:
    std::span<const std::uint8_t> buffer(const Value& reference);
    std::span<const std::uint8_t> read_buffer(const Value& buffer, std::size_t index);
    std::span<const std::uint8_t> slice(const Value& view);
    View decompress(const Value& compressed, std::uint64_t declared_bytes, std::size_t index);

    std::string name_;
    Folder folder_;
    std::vector<std::uint8_t> file_;
    std::optional<std::span<const std::uint8_t>> binary_;
    std::shared_ptr<const nlohmann::json> json_;
    std::map<std::size_t, std::vector<std::uint8_t>> buffers_, decompressed_;
    std::uint64_t budget_ = max_scene_bytes;
    std::map<std::string, int> warnings_;
};

} // namespace luxel::gltf
