// SPDX-License-Identifier: MIT
#include "core/temporary_folder.h"

#include <stdlib.h>

#include "core/error.h"

namespace luxel {

TemporaryFolder::TemporaryFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "luxel-XXXXXX").string();
    if (!mkdtemp(pattern.data())) fail(Fault::io, "{}: cannot make this folder", pattern);
    path_ = pattern;
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

} // namespace luxel
