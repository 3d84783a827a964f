// SPDX-License-Identifier: MIT
// Where results go, tried before any work is done.
#pragma once
#include <filesystem>

namespace luxel {

// Of the views that are finished, within the folder of results.
inline constexpr const char* journal_folder = "views";
inline constexpr const char* journal_lock = "lock"; // its file that says that a run is at work

// Makes the folder and proves that files can be made in it. Error Fault::io otherwise. Unless kept, what was
// made is taken away again as far as it is empty, so that a failed run leaves nothing.
class OutputFolder {
public:
    explicit OutputFolder(std::filesystem::path folder);
    ~OutputFolder();
    OutputFolder(const OutputFolder&) = delete;
    OutputFolder& operator=(const OutputFolder&) = delete;
    const std::filesystem::path& path() const { return folder_; }
    void keep() { kept_ = true; }

private:
    std::filesystem::path folder_, first_made_; // first_made_: the outermost folder that was not there before
    bool kept_ = false;
};

// Error Fault::io unless a file could be made at this place (its folder must be there).
void check_writable(const std::filesystem::path& file);

} // namespace luxel
