// SPDX-License-Identifier: MIT
#include "experiments/cache_folder.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>

#include "core/error.h"
#include "experiments/reference_cache.h"

namespace luxel {

namespace {

constexpr std::uint64_t default_limit = std::uint64_t(10) << 30;

// What is gone by the time it is looked at was pruned by another run.
void add_file(const std::filesystem::directory_entry& entry, std::vector<CachedFile>& files) {
    const std::string ending = entry.path().extension().string();
    if (ending != ".reference" && ending != ".checkpoint") return;
    std::error_code error;
    CachedFile file{
        .file = entry.path(), .bytes = entry.file_size(error), .checkpoint = ending == ".checkpoint"};
    if (error) return;
    file.used = entry.last_write_time(error);
    if (error) return;
    if (!file.checkpoint) describe_truth(file);
    files.push_back(std::move(file));
}

} // namespace

std::vector<CachedFile> cached_files(const std::filesystem::path& folder) {
    std::vector<CachedFile> files;
    if (!std::filesystem::exists(folder)) return files;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) add_file(entry, files);
    std::sort(files.begin(), files.end(), [](const CachedFile& a, const CachedFile& b) {
        return a.used != b.used ? a.used < b.used : a.file < b.file;
    });
    return files;
}

std::uint64_t parse_size_limit(std::string_view option, std::string_view text) {
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const std::string_view unit = text.substr(std::size_t(end - text.data()));
    constexpr std::string_view units = "KMGT";
    const std::size_t power = unit.empty() ? 0 : units.find(unit[0]) + 1; // 0 where the unit is unknown
    const bool known = unit.empty() || (power > 0 && (unit.size() == 1 || unit.substr(1) == "iB"));
    const double bytes = std::ldexp(value, int(10 * power));
    if (error != std::errc() || !known || !(bytes >= 0.0 && bytes < 1e18))
        fail(Fault::usage, "{} {}: expected a size such as 500M or 2.5G", option, text);
    return std::uint64_t(bytes);
}

std::uint64_t cache_limit() {
    const char* text = std::getenv("LUXEL_CACHE_LIMIT");
    return text && *text ? parse_size_limit("LUXEL_CACHE_LIMIT", text) : default_limit;
}

Pruned prune_cache(const std::filesystem::path& folder, std::uint64_t limit,
                   const std::filesystem::path& kept) {
    const std::vector<CachedFile> files = cached_files(folder);
    std::uint64_t all = 0;
    for (const CachedFile& file : files) all += file.bytes;
    Pruned pruned;
    for (const CachedFile& file : files) {
        if (all <= limit) break;
        std::error_code error;
        if (file.file == kept || !std::filesystem::remove(file.file, error)) continue;
        all -= file.bytes;
        ++pruned.files, pruned.bytes += file.bytes;
    }
    return pruned;
}

void mark_used(const std::filesystem::path& file) {
    std::error_code error; // a cache that cannot be written is still of use
    std::filesystem::last_write_time(file, std::filesystem::file_time_type::clock::now(), error);
}

} // namespace luxel
