// SPDX-License-Identifier: MIT
// A new folder in the system's place for temporary files, removed with all that is in it.
#pragma once
#include <filesystem>

namespace luxel {

class TemporaryFolder {
public:
    TemporaryFolder(); // Error Fault::io: it cannot be made
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

} // namespace luxel
