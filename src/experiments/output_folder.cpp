// SPDX-License-Identifier: MIT
#include "experiments/output_folder.h"

#include <cerrno>
#include <cstring>
#include <system_error>

#include <fcntl.h>
#include <unistd.h>

#include "core/error.h"

namespace luxel {

namespace {

// Only making a file tells: permissions lie for root and on read-only file systems.
void probe(const std::filesystem::path& folder, const std::filesystem::path& blamed) {
    std::string name = (folder / ".luxel-XXXXXX").string();
    const int descriptor = ::mkstemp(name.data());
    if (descriptor < 0)
        fail(Fault::io, "{}: output: cannot write there: {}", blamed.string(), std::strerror(errno));
    ::close(descriptor);
    ::unlink(name.c_str());
}

} // namespace

OutputFolder::OutputFolder(std::filesystem::path folder) : folder_(std::move(folder)) {
    std::error_code error;
    for (std::filesystem::path p = std::filesystem::absolute(folder_); !std::filesystem::exists(p, error);
         p = p.parent_path()) {
        if (!p.filename().empty()) first_made_ = p;
        if (p == p.parent_path()) break;
    }
    std::filesystem::create_directories(folder_, error);
    if (!std::filesystem::is_directory(folder_))
        fail(Fault::io, "{}: output: cannot make this folder: {}", folder_.string(),
             error ? error.message() : "a file of that name is there");
    probe(folder_, folder_);
}

OutputFolder::~OutputFolder() {
    if (kept_ || first_made_.empty()) return;
    // Innermost first, an empty folder of finished views among them; remove() refuses a folder that holds
    // something.
    std::error_code error;
    const std::filesystem::path views = folder_ / journal_folder;
    std::filesystem::remove(views / journal_lock, error);
    std::filesystem::remove(views, error);
    for (std::filesystem::path p = std::filesystem::absolute(folder_);; p = p.parent_path()) {
        if (p.filename().empty()) continue;
        if (!std::filesystem::remove(p, error) || p == first_made_) break;
    }
}

void check_writable(const std::filesystem::path& file) {
    std::error_code error;
    if (std::filesystem::is_directory(file, error))
        fail(Fault::io, "{}: output: this is a folder", file.string());
    const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
    probe(folder, file);
}

} // namespace luxel
