// SPDX-License-Identifier: MIT
// The sums of an unfinished run in a file.
//
// Little endian: 8 bytes "LUXELCP1", u64 key of the inputs, u64 samples per pixel, u64 count, count doubles,
// u64 checksum of all before it.
#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace luxel {

// Replaces the file whole or not at all.
void write_checkpoint(const std::filesystem::path& file, std::uint64_t key, int spp,
                      const std::vector<double>& sums);

struct CheckpointFound {
    int spp = 0;         // 0: nothing usable, `sums` is as it was
    std::string warning; // why a file that is there is not used; empty otherwise
};
// Fills `sums`, whose size is the one expected, when the file is sound, has this key and at most `most`
// samples.
CheckpointFound read_checkpoint(const std::filesystem::path& file, std::uint64_t key, int most,
                                std::vector<double>& sums);

} // namespace luxel
