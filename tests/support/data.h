// SPDX-License-Identifier: MIT
// Optional real scenes: LUXEL_DATA in the environment, or the folder configured at build time.
#pragma once
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>

namespace luxel::testing {

inline std::optional<std::filesystem::path> data_file(const std::string& relative) {
    const char* root = std::getenv("LUXEL_DATA");
    std::filesystem::path path = std::filesystem::path(root ? root : LUXEL_DATA_DIR) / relative;
    if (!std::filesystem::exists(path)) return std::nullopt;
    return path;
}

// GTEST_SKIP with a sentence when the file is absent.
#define LUXEL_DATA_OR_SKIP(variable, relative)                                                               \
    auto variable##_found = ::luxel::testing::data_file(relative);                                           \
    if (!variable##_found) GTEST_SKIP() << "no " << relative << " on this machine";                          \
    const std::filesystem::path variable = *variable##_found

} // namespace luxel::testing
