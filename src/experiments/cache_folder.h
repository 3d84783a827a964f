// SPDX-License-Identifier: MIT
// The folder of cached truths: what is in it, and keeping it within a size.
#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace luxel {

struct CachedFile {
    std::filesystem::path file;
    std::uint64_t bytes = 0;
    std::filesystem::file_time_type used; // last written or read
    // Of a truth; empty and 0 of a checkpoint and of what is damaged.
    std::vector<std::string> components;
    int width = 0, height = 0, spp = 0;
    bool checkpoint = false; // of a truth that was stopped
};

// Truths and checkpoints, least recently used first; other files are left alone. Error Fault::io.
std::vector<CachedFile> cached_files(const std::filesystem::path& folder);

// "500M", "2.5G", "0": bytes, with K, M, G, T for powers of 1024. Error Fault::usage.
std::uint64_t parse_size_limit(std::string_view option, std::string_view text);

// LUXEL_CACHE_LIMIT of the environment, or 10 GiB.
std::uint64_t cache_limit();

// Removes the least recently used until the rest is within the limit; never `kept`.
struct Pruned {
    int files = 0;
    std::uint64_t bytes = 0;
};
Pruned prune_cache(const std::filesystem::path& folder, std::uint64_t limit,
                   const std::filesystem::path& kept = {});

// Says that it has been used now.
void mark_used(const std::filesystem::path& file);

} // namespace luxel
