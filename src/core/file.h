// SPDX-License-Identifier: MIT
// Files read safely and written whole.
#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace luxel {

// Whole regular file, at most `limit` bytes. Error: Fault::io (cannot open), Fault::bad_input (too large, no
// file).
std::vector<std::uint8_t> read_file(const std::filesystem::path& file, std::uint64_t limit = std::uint64_t(2)
                                                                                             << 30);

// Opens files beneath one folder only: no "..", no absolute path, no symlink, no device, FIFO or directory.
// The path is walked one component at a time without following links, which no concurrent rename can escape.
class Folder {
public:
    explicit Folder(std::filesystem::path root) : root_(std::move(root)) {}
    const std::filesystem::path& root() const { return root_; }
    // nullopt: no such file. Error Fault::bad_input: the path leaves the folder or is no regular file.
    std::optional<std::vector<std::uint8_t>> read(std::string_view relative, std::uint64_t limit) const;

private:
    std::filesystem::path root_;
};

// Calls write(temporary path beside `file`), syncs and renames; on an exception the temporary is removed.
void write_atomically(const std::filesystem::path& file,
                      const std::function<void(const std::filesystem::path&)>& write);
void write_file(const std::filesystem::path& file, std::span<const std::uint8_t> bytes);
void write_file(const std::filesystem::path& file, std::string_view text);

} // namespace luxel
