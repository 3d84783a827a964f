// SPDX-License-Identifier: MIT
#include "reference/checkpoint.h"

#include <bit>
#include <cstring>

#include "core/error.h"
#include "core/file.h"
#include "reference/content_key.h"

namespace luxel {
namespace {

static_assert(std::endian::native == std::endian::little, "checkpoints are written as they lie in memory");

constexpr char magic[8] = {'L', 'U', 'X', 'E', 'L', 'C', 'P', '2'};

struct Header {
    char magic[8];
    std::uint64_t key, spp, count;
};

std::uint64_t checksum(const std::uint8_t* bytes, std::size_t size) {
    ContentKey sum;
    sum.add_bytes(bytes, size);
    return sum.value();
}

} // namespace

void write_checkpoint(const std::filesystem::path& file, std::uint64_t key, int spp,
                      const std::vector<double>& sums) {
    Header header{{}, key, std::uint64_t(spp), sums.size()};
    std::memcpy(header.magic, magic, sizeof magic);
    const std::size_t payload = sums.size() * sizeof(double), body = sizeof header + payload;
    std::vector<std::uint8_t> bytes(body + sizeof(std::uint64_t));
    std::memcpy(bytes.data(), &header, sizeof header);
    if (payload > 0) std::memcpy(bytes.data() + sizeof header, sums.data(), payload);
    std::uint64_t sum = checksum(bytes.data(), body);
    std::memcpy(bytes.data() + body, &sum, sizeof sum);
    write_file(file, bytes);
}

CheckpointFound read_checkpoint(const std::filesystem::path& file, std::uint64_t key, int most,
                                std::vector<double>& sums) {
    std::error_code ignored;
    if (!std::filesystem::exists(file, ignored)) return {};
    auto unused = [&](const std::string& reason) {
        return CheckpointFound{0, fmt::format("{}: checkpoint: {}; starting anew", file.string(), reason)};
    };

    const std::size_t payload = sums.size() * sizeof(double), body = sizeof(Header) + payload;
    std::vector<std::uint8_t> bytes;
    try {
        bytes = read_file(file);
    } catch (const Error& error) {
        return unused(error.what());
    }
    Header header{};
    if (bytes.size() < sizeof header) return unused("too short");
    std::memcpy(&header, bytes.data(), sizeof header);
    if (std::memcmp(header.magic, magic, sizeof magic) != 0)
        return unused("not a checkpoint of this version");
    if (header.key != key) return unused("made for another scene, view or setting");
    if (header.count != sums.size() || bytes.size() != body + sizeof(std::uint64_t))
        return unused("truncated");
    std::uint64_t sum = 0;
    std::memcpy(&sum, bytes.data() + body, sizeof sum);
    if (sum != checksum(bytes.data(), body)) return unused("damaged, the checksum differs");
    if (header.spp > std::uint64_t(most)) return unused("holds more samples than asked for");
    if (payload > 0) std::memcpy(sums.data(), bytes.data() + sizeof header, payload);
    return {int(header.spp), ""};
}

} // namespace luxel
