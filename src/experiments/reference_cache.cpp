// SPDX-License-Identifier: MIT
// File: magic, key, checksum of the rest; then a JSON line that says what follows; then floats as they lie in
// memory.
#include "experiments/reference_cache.h"

#include <chrono>
#include <cstdlib>
#include <cstring>
#include <fstream>

#include <nlohmann/json.hpp>

#include "core/error.h"
#include "core/file.h"
#include "experiments/cache_folder.h"
#include "experiments/output_folder.h"
#include "reference/content_key.h"

namespace luxel {

namespace {

constexpr std::string_view magic = "luxel reference 2\n";
constexpr std::uint64_t largest_file = std::uint64_t(8) << 30;

constexpr std::size_t key_size = 16;

std::string digits(const ContentKey& key) { return fmt::format("{:016x}", key.value()); }

std::string checksum(std::string_view bytes) {
    ContentKey key;
    key.add(bytes);
    return digits(key);
}

// An image of a truth, in file order.
struct Block {
    std::string group, name;
    const Image* image;
};

std::vector<Block> blocks_of(const Truth& truth) {
    std::vector<Block> blocks = {{"mask", "", &truth.mask}};
    for (const auto& [name, image] : truth.mean) blocks.push_back({"mean", name, &image});
    for (std::size_t i = 0; i < truth.group.size(); ++i)
        for (const auto& [name, image] : truth.group[i])
            blocks.push_back({fmt::format("group{}", i), name, &image});
    return blocks;
}

Image& place_of(Truth& truth, const std::string& group, const std::string& name) {
    if (group == "mask") return truth.mask;
    if (group == "mean") return truth.mean[name];
    return truth.group[std::size_t(group.back() - '0')][name];
}

std::string encode(const Truth& truth) {
    nlohmann::json description = {{"spp", truth.spp}, {"seconds", truth.seconds}};
    for (const Block& b : blocks_of(truth))
        description["images"].push_back({{"group", b.group},
                                         {"name", b.name},
                                         {"width", b.image->width},
                                         {"height", b.image->height},
                                         {"channels", b.image->channels}});
    std::string bytes = description.dump() + "\n";
    for (const Block& b : blocks_of(truth))
        bytes.append(reinterpret_cast<const char*>(b.image->data.data()),
                     b.image->data.size() * sizeof(float));
    return bytes;
}

// The checksum vouches that encode() wrote these bytes, so the description can be trusted.
Truth decode(std::string_view bytes) {
    const std::size_t end = bytes.find('\n');
    const nlohmann::json description = nlohmann::json::parse(bytes.substr(0, end));
    bytes.remove_prefix(end + 1);

    Truth truth;
    truth.spp = description.at("spp");
    truth.seconds = description.at("seconds");
    for (const nlohmann::json& entry : description.at("images")) {
        Image image(entry.at("width"), entry.at("height"), entry.at("channels"));
        const std::size_t size = image.data.size() * sizeof(float);
        LUXEL_ASSERT(size <= bytes.size(), "size={} left={}", size, bytes.size());
        std::memcpy(image.data.data(), bytes.data(), size);
        bytes.remove_prefix(size);
        place_of(truth, entry.at("group"), entry.at("name")) = std::move(image);
    }
    return truth;
}

// Where a cache cannot be written, truths are rendered all the same.
bool can_hold_files(const std::filesystem::path& folder) {
    if (folder.empty()) return false;
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    try {
        check_writable(folder / "truth");
    } catch (const Error&) {
        return false;
    }
    return true;
}

} // namespace

std::filesystem::path default_cache_folder() {
    const char* cache = std::getenv("XDG_CACHE_HOME");
    if (cache && *cache) return std::filesystem::path(cache) / "luxel";
    const char* home = std::getenv("HOME");
    if (home && *home) return std::filesystem::path(home) / ".cache" / "luxel";
    return {};
}

std::string reference_key(const Scene& scene, const ReferenceRequest& request) {
    ContentKey key;
    key.add(content_key(scene, request));
    key.add(request.settings.spp), key.add(request.settings.seconds), key.add(request.settings.error);
    return digits(key);
}

std::optional<Truth> load_truth(const std::filesystem::path& file, const std::string& key,
                                std::vector<std::string>& warnings) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(file, error)) return std::nullopt;
    const std::vector<std::uint8_t> bytes = read_file(file, largest_file);
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());

    const std::size_t header = magic.size() + 2 * key_size + 1;
    const bool complete = text.size() > header && text.substr(0, magic.size()) == magic;
    if (complete && text.substr(magic.size(), key_size) == key) {
        const std::string_view rest = text.substr(header);
        if (text.substr(magic.size() + key_size, key_size) == checksum(rest)) return decode(rest);
    }
    warnings.push_back(fmt::format("{}: cached reference: it is damaged and will be rebuilt", file.string()));
    return std::nullopt;
}

void store_truth(const std::filesystem::path& file, const std::string& key, const Truth& truth) {
    const std::string rest = encode(truth);
    write_file(file, std::string(magic) + key + checksum(rest) + "\n" + rest);
}

void describe_truth(CachedFile& file) {
    std::ifstream stream(file.file, std::ios::binary);
    std::string header(magic.size() + 2 * key_size + 1, '\0'), line;
    if (!stream.read(header.data(), std::streamsize(header.size())) || !header.starts_with(magic) ||
        !std::getline(stream, line))
        return;
    try {
        const nlohmann::json description = nlohmann::json::parse(line);
        for (const nlohmann::json& image : description.at("images")) {
            if (image.at("group") != "mean") continue;
            file.components.push_back(image.at("name"));
            file.width = image.at("width"), file.height = image.at("height");
        }
        file.spp = description.at("spp");
    } catch (const nlohmann::json::exception&) {
        file.components.clear(), file.width = file.height = file.spp = 0;
    }
}

Truth find_truth(const RayCaster& rays, const ReferenceRequest& asked, const std::filesystem::path& folder,
                 std::vector<std::string>& warnings, const TruthWatch& watch) {
    ReferenceRequest request = asked;
    bool stopped = false;
    if (watch) request.watch = [&](int spp) { return !(stopped = !watch(spp)); };
    const std::string key = reference_key(rays.scene(), request);
    if (can_hold_files(folder)) request.checkpoint = folder / (key + ".checkpoint");

    Truth found = find_truth(key, folder, warnings, [&] {
        const auto start = std::chrono::steady_clock::now();
        Estimate estimate = render_reference(rays, request);
        warnings.insert(warnings.end(), estimate.warnings.begin(), estimate.warnings.end());
        Truth truth;
        truth.spp = estimate.spp;
        truth.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        truth.mean = std::move(estimate.mean);
        truth.group = std::move(estimate.group);
        truth.mask = std::move(estimate.mask);
        truth.complete = !stopped || truth.spp >= request.settings.spp;
        return truth;
    });
    std::error_code error; // it is there where it could be written
    if (found.complete && !request.checkpoint.empty()) std::filesystem::remove(request.checkpoint, error);
    return found;
}

Truth find_truth(const std::string& key, const std::filesystem::path& folder,
                 std::vector<std::string>& warnings, const std::function<Truth()>& render) {
    const std::filesystem::path file = folder / (key + ".reference");
    if (!folder.empty()) {
        std::optional<Truth> found = load_truth(file, key, warnings);
        if (found) {
            found->cached = true;
            mark_used(file);
            return std::move(*found);
        }
    }

    const Truth truth = render();
    // The images are at hand whether or not they can be kept.
    if (folder.empty() || !truth.complete) return truth;
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    try {
        store_truth(file, key, truth);
        prune_cache(folder, cache_limit(), file);
    } catch (const Error& e) {
        warnings.push_back(fmt::format("the reference is not cached: {}", e.what()));
    }
    return truth;
}

} // namespace luxel
