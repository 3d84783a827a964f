// SPDX-License-Identifier: MIT
// A folder of its own for each test, removed with everything in it.
#pragma once
#include <filesystem>
#include <string>
#include <string_view>

#include <stdlib.h>

#include "core/file.h"

namespace luxel::testing {

class TemporaryFolder {
public:
    TemporaryFolder() {
        std::string pattern = (std::filesystem::temp_directory_path() / "luxel-test-XXXXXX").string();
        path_ = mkdtemp(pattern.data());
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    ~TemporaryFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }

    const std::filesystem::path& path() const { return path_; }

    // A file of that content; folders on the way are made.
    template <class Content>
    std::filesystem::path add(const std::string& name, const Content& content) const {
        const std::filesystem::path file = path_ / name;
        std::filesystem::create_directories(file.parent_path());
        write_file(file, content);
        return file;
    }

private:
    std::filesystem::path path_;
};

} // namespace luxel::testing
