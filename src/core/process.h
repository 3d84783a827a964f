// SPDX-License-Identifier: MIT
// Other programs, run to their end without a shell.
#pragma once
#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

namespace luxel {

struct Process {
    std::string program; // looked up in PATH
    std::vector<std::string> arguments;
    std::filesystem::path folder; // it works in; its output goes to the file "log" there
    std::chrono::seconds limit{60};
};

bool is_installed(const std::string& program);

// Error: Fault::unsupported (not there), Fault::resource (cannot start, or ended at the limit),
// Fault::bad_input (an exit code that is not 0; with the last line it wrote).
void run_process(const Process& process);

} // namespace luxel
