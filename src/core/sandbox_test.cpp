// SPDX-License-Identifier: MIT
// Each thing that a decoder must not do, tried from within.
#include "core/sandbox.h"

#include <cerrno>
#include <cstdlib>
#include <functional>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

namespace {

// What `attempt` returns, in a child within the sandbox; 200 where the kernel has no filter.
int within(const std::function<int()>& attempt) {
    const pid_t child = fork();
    if (child == 0) _exit(luxel::enter_sandbox() ? attempt() : 200);
    int status = 0;
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 201;
}

// 0: refused by the filter, 1: refused otherwise, 2: done.
int refused(long result) { return result >= 0 ? 2 : errno == EPERM ? 0 : 1; }

bool is_sanitized() {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    return true;
#else
    return false;
#endif
}

} // namespace

TEST(Sandbox, FilesSocketsAndProgramsAreRefused) {
    if (is_sanitized()) GTEST_SKIP() << "sanitizers need the system";
    EXPECT_EQ(within([] { return 42; }), 42);
    EXPECT_EQ(within([] { return refused(open("/etc/hostname", O_RDONLY)); }), 0);
    EXPECT_EQ(within([] { return refused(open("/tmp/luxel-sandbox", O_WRONLY | O_CREAT, 0600)); }), 0);
    EXPECT_EQ(within([] { return refused(socket(AF_INET, SOCK_STREAM, 0)); }), 0);
    EXPECT_EQ(within([] { return refused(socket(AF_UNIX, SOCK_STREAM, 0)); }), 0);
    EXPECT_EQ(within([] {
                  char name[] = "/bin/true";
                  char* arguments[] = {name, nullptr};
                  return refused(execve(name, arguments, nullptr));
              }),
              0);
    EXPECT_EQ(within([] { return refused(fork()); }), 0);
    EXPECT_EQ(within([] { return refused(kill(getppid(), 0)); }), 0);
    EXPECT_EQ(within([] { return refused(dup(0)); }), 0);
    EXPECT_EQ(within([] {
                  void* code = mmap(nullptr, 4096, PROT_READ | PROT_WRITE | PROT_EXEC,
                                    MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
                  return refused(code == MAP_FAILED ? -1 : 0);
              }),
              0);
}

TEST(Sandbox, MemoryIsCapped) {
    if (is_sanitized()) GTEST_SKIP() << "sanitizers need the system";
    EXPECT_EQ(within([] { return std::malloc(std::size_t(1) << 30) ? 0 : 1; }), 0);
    EXPECT_EQ(within([] { return std::malloc(std::size_t(5) << 30) ? 0 : 1; }), 1);
}

// Privileges stay given up, by the kernel's own word, seen from the parent.
TEST(Sandbox, NoNewPrivileges) {
    int ends[2], started[2];
    ASSERT_EQ(pipe(ends), 0);
    ASSERT_EQ(pipe(started), 0);
    const pid_t child = fork();
    if (child == 0) {
        dup2(ends[0], STDIN_FILENO), dup2(started[1], STDOUT_FILENO);
        const bool filtered = luxel::enter_sandbox();
        char byte = filtered ? 1 : 0;
        if (write(STDOUT_FILENO, &byte, 1) != 1 || read(STDIN_FILENO, &byte, 1) < 0) _exit(1);
        _exit(0);
    }
    char byte = 0;
    ASSERT_EQ(read(started[0], &byte, 1), 1);
    std::string status;
    if (FILE* file = fopen(("/proc/" + std::to_string(child) + "/status").c_str(), "r")) {
        char line[256];
        while (fgets(line, sizeof line, file)) status += line;
        fclose(file);
    }
    EXPECT_NE(status.find("NoNewPrivs:\t1"), std::string::npos) << status;
    EXPECT_EQ(write(ends[1], &byte, 1), 1);
    int ended = 0;
    waitpid(child, &ended, 0);
    for (int end : {ends[0], ends[1], started[0], started[1]}) close(end);
}
