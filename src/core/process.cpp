// SPDX-License-Identifier: MIT
// posix_spawn, and a descriptor of the process to wait on with a limit.
#include "core/process.h"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <sstream>

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/descriptor.h"
#include "core/error.h"
#include "core/file.h"

extern char** environ; // POSIX declares it nowhere

namespace luxel {
namespace {

constexpr std::uint64_t max_log_bytes = std::uint64_t(16) << 20;

pid_t spawn(const Process& process) {
    std::vector<std::string> texts = {process.program};
    texts.insert(texts.end(), process.arguments.begin(), process.arguments.end());
    std::vector<char*> arguments;
    for (std::string& text : texts) arguments.push_back(text.data());
    arguments.push_back(nullptr);

    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addchdir_np(&actions, process.folder.c_str());
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "log", O_WRONLY | O_CREAT | O_TRUNC, 0600);
    posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
    pid_t pid = -1;
    const int error =
        posix_spawnp(&pid, process.program.c_str(), &actions, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    if (error != 0) fail(Fault::resource, "{}: cannot start: {}", process.program, std::strerror(error));
    return pid;
}

// Whether the process ended within the limit.
bool ends(pid_t pid, std::chrono::seconds limit) {
    const Descriptor process(int(syscall(SYS_pidfd_open, pid, 0)));
    if (process.value < 0) return true; // waited for without a limit
    const auto deadline = std::chrono::steady_clock::now() + limit;
    while (true) {
        const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(
            deadline - std::chrono::steady_clock::now());
        if (left.count() <= 0) return false;
        pollfd waiting{process.value, POLLIN, 0};
        const int ready = poll(&waiting, 1, int(std::min<long long>(left.count(), 60000)));
        if (ready > 0) return true;
        if (ready < 0 && errno != EINTR) return true;
    }
}

std::string last_line(const std::filesystem::path& log) {
    const std::vector<std::uint8_t> bytes = read_file(log, max_log_bytes);
    std::istringstream stream(std::string(bytes.begin(), bytes.end()));
    std::string last, line;
    while (std::getline(stream, line))
        if (line.find_first_not_of(" \t\r") != line.npos) last = line;
    for (char& c : last)
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
    return last.substr(0, 200);
}

} // namespace

bool is_installed(const std::string& program) {
    const char* path = std::getenv("PATH");
    std::istringstream folders(path ? path : "");
    for (std::string folder; std::getline(folders, folder, ':');)
        if (access((std::filesystem::path(folder) / program).c_str(), X_OK) == 0) return true;
    return false;
}

void run_process(const Process& process) {
    if (!is_installed(process.program))
        fail(Fault::unsupported, "{}: this program is not installed", process.program);
    const pid_t pid = spawn(process);
    const bool in_time = ends(pid, process.limit);
    if (!in_time) kill(pid, SIGKILL);
    int status = 0;
    while (waitpid(pid, &status, 0) < 0 && errno == EINTR) {
    }
    if (!in_time) fail(Fault::resource, "{}: not done after {} s", process.program, process.limit.count());
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return;
    const std::string how =
        WIFSIGNALED(status) ? strsignal(WTERMSIG(status)) : fmt::format("exit code {}", WEXITSTATUS(status));
    fail(Fault::bad_input, "{}: {}: {}", process.program, how, last_line(process.folder / "log"));
}

} // namespace luxel
