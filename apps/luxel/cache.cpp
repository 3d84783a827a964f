// SPDX-License-Identifier: MIT
// luxel cache: what truths are kept, how large they are, and fewer of them.
#include <chrono>
#include <cstdio>

#include <fmt/ranges.h>

#include "core/error.h"
#include "experiments/cache_folder.h"
#include "experiments/table.h"
#include "options.h"

namespace luxel::app {

namespace {

struct Options {
    std::string action = "list", limit;
    CacheChoice cache;
};

std::string size_text(std::uint64_t bytes) { return fmt::format("{:.1f} MiB", double(bytes) / 1048576.0); }

double hours_since(std::filesystem::file_time_type time) {
    return std::chrono::duration<double, std::ratio<3600>>(std::filesystem::file_time_type::clock::now() -
                                                           time)
        .count();
}

nlohmann::ordered_json describe(const CachedFile& file) {
    return {{"file", file.file.string()},    {"bytes", file.bytes},
            {"components", file.components}, {"width", file.width},
            {"height", file.height},         {"spp", file.spp},
            {"checkpoint", file.checkpoint}, {"hours_unused", hours_since(file.used)}};
}

void list(const std::vector<CachedFile>& files) {
    std::vector<std::vector<std::string>> cells = {
        {"file", "size", "pixels", "samples", "hours unused", "holds"}};
    for (const CachedFile& file : files)
        cells.push_back({file.file.filename().string(), size_text(file.bytes),
                         file.spp > 0 ? fmt::format("{}x{}", file.width, file.height) : "-",
                         file.spp > 0 ? fmt::format("{}", file.spp) : "-",
                         fmt::format("{:.1f}", hours_since(file.used)),
                         file.checkpoint ? "an unfinished truth"
                         : file.spp > 0  ? fmt::format("{}", fmt::join(file.components, "+"))
                                         : "damaged"});
    fmt::print("{}", format_table(cells));
}

void run(const Options& o, const Global& global) {
    const std::filesystem::path folder = o.cache.path();
    if (folder.empty()) fail(Fault::usage, "cache: there is no folder; give --cache DIR");
    if (!o.limit.empty() && o.action != "prune")
        fail(Fault::usage,
             "--limit: only luxel cache prune takes it; LUXEL_CACHE_LIMIT is that of every run");
    const std::uint64_t limit = o.limit.empty() ? cache_limit() : parse_size_limit("--limit", o.limit);
    Pruned pruned;
    if (o.action == "prune") pruned = prune_cache(folder, limit);

    const std::vector<CachedFile> files = cached_files(folder);
    std::uint64_t bytes = 0;
    for (const CachedFile& file : files) bytes += file.bytes;
    if (global.json) {
        nlohmann::ordered_json json = {{"folder", folder.string()},
                                       {"files", nlohmann::ordered_json::array()},
                                       {"bytes", bytes},
                                       {"limit", limit},
                                       {"removed", pruned.files},
                                       {"removed_bytes", pruned.bytes}};
        for (const CachedFile& file : files) json["files"].push_back(describe(file));
        return print_json(json);
    }
    if (o.action == "list" && !files.empty()) list(files);
    if (o.action == "prune") fmt::print("{} files removed, {}\n", pruned.files, size_text(pruned.bytes));
    fmt::print("{}: {} files, {} of at most {}\n", folder.string(), files.size(), size_text(bytes),
               size_text(limit));
}

} // namespace

void add_cache(CLI::App& app, const Global& global) {
    auto o = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand("cache", "List the truths that are kept, or remove the oldest");
    command->add_option("action", o->action, "list, size or prune")
        ->check(CLI::IsMember({"list", "size", "prune"}))
        ->capture_default_str();
    command->add_option("--limit", o->limit, "Of prune: what may stay, such as 500M, 2G or 0");
    add_cache_options(*command, o->cache);
    command->footer("A run that stores a truth removes those that were not used for longest, as soon as the "
                    "folder holds\n"
                    "more than LUXEL_CACHE_LIMIT of the environment, or 10 GiB.\n"
                    "Examples:\n"
                    "  luxel cache\n"
                    "  luxel cache prune --limit 2G");
    command->callback([o, &global] { run(*o, global); });
}

} // namespace luxel::app
