// SPDX-License-Identifier: MIT
// Runs the built luxel program as a user would.
#pragma once
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <sys/wait.h>

#include "support/build_folders.h"
#include "support/temporary_folder.h"

namespace luxel::testing {

inline std::string slurp(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}
inline void spill(const std::filesystem::path& file, const std::string& bytes) {
    std::ofstream(file, std::ios::binary) << bytes;
}

struct ProcessResult {
    int code = -1; // 128 + signal when it died of one
    std::string out, error;
    std::size_t error_lines() const { return std::size_t(std::count(error.begin(), error.end(), '\n')); }
};

inline ProcessResult run_luxel(const std::vector<std::string>& arguments) {
    const TemporaryFolder folder;
    const auto quoted = [](const std::string& text) {
        std::string out = "'";
        for (char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
        return out + "'";
    };
    std::string command = quoted(LUXEL_BINARY_DIR "/luxel");
    for (const std::string& argument : arguments) command += " " + quoted(argument);
    command +=
        " >" + quoted((folder.path() / "out").string()) + " 2>" + quoted((folder.path() / "error").string());

    ProcessResult result;
    const int status = std::system(command.c_str());
    result.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    result.out = slurp(folder.path() / "out");
    result.error = slurp(folder.path() / "error");
    return result;
}

} // namespace luxel::testing
