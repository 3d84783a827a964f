// SPDX-License-Identifier: MIT
// A folder of its own for each test, removed with everything in it.
#pragma once
#include <filesystem>
#include <string>
#include <string_view>

#include "core/file.h"
#include "core/temporary_folder.h"

namespace luxel::testing {

class TemporaryFolder : public luxel::TemporaryFolder {
public:
    // A file of that content; folders on the way are made.
    template <class Content>
    std::filesystem::path add(const std::string& name, const Content& content) const {
        const std::filesystem::path file = path() / name;
        std::filesystem::create_directories(file.parent_path());
        write_file(file, content);
        return file;
    }
};

} // namespace luxel::testing
