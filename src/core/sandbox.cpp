// SPDX-License-Identifier: MIT
#include "core/sandbox.h"

#include <cerrno>
#include <csignal>
#include <initializer_list>

#include <seccomp.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

namespace luxel {
namespace {

constexpr rlim_t address_space = rlim_t(4) << 30;

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool sanitized = true;
#else
constexpr bool sanitized = false;
#endif

void cap(decltype(RLIMIT_AS) resource, rlim_t most) {
    const rlimit limit{most, most};
    if (setrlimit(resource, &limit) != 0) _exit(1);
}

// What decoding takes: reading and writing what is open, memory that is not executed, and an end.
bool allow_calls(scmp_filter_ctx filter) {
    for (const int call :
         {SCMP_SYS(read),           SCMP_SYS(readv),        SCMP_SYS(write),           SCMP_SYS(writev),
          SCMP_SYS(lseek),          SCMP_SYS(close),        SCMP_SYS(fstat),           SCMP_SYS(brk),
          SCMP_SYS(munmap),         SCMP_SYS(mremap),       SCMP_SYS(madvise),         SCMP_SYS(futex),
          SCMP_SYS(clock_gettime),  SCMP_SYS(gettimeofday), SCMP_SYS(getrandom),       SCMP_SYS(sched_yield),
          SCMP_SYS(getpid),         SCMP_SYS(gettid),       SCMP_SYS(tgkill),          SCMP_SYS(rt_sigreturn),
          SCMP_SYS(rt_sigprocmask), SCMP_SYS(rt_sigaction), SCMP_SYS(restart_syscall), SCMP_SYS(exit),
          SCMP_SYS(exit_group)})
        if (seccomp_rule_add(filter, SCMP_ACT_ALLOW, call, 0) != 0) return false;
    const scmp_arg_cmp not_executable = SCMP_A2(SCMP_CMP_MASKED_EQ, PROT_EXEC, 0);
    return seccomp_rule_add(filter, SCMP_ACT_ALLOW, SCMP_SYS(mmap), 1, not_executable) == 0 &&
           seccomp_rule_add(filter, SCMP_ACT_ALLOW, SCMP_SYS(mprotect), 1, not_executable) == 0;
}

// Everything else fails with EPERM, which libraries take as well as any other refusal.
bool filter_calls() {
    const scmp_filter_ctx filter = seccomp_init(SCMP_ACT_ERRNO(EPERM));
    if (!filter) return false;
    const bool loaded = allow_calls(filter) && seccomp_load(filter) == 0;
    seccomp_release(filter);
    return loaded;
}

} // namespace

bool enter_sandbox() {
    if (close_range(3, ~0U, 0) != 0) _exit(1);
    if (prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0) _exit(1);
    prctl(PR_SET_PDEATHSIG, SIGKILL); // where it cannot be had, the time limits end the process
    cap(RLIMIT_FSIZE, 0);
    cap(RLIMIT_CORE, 0);
    cap(RLIMIT_CPU, sandbox_processor_seconds);
    // Sanitizers reserve terabytes of addresses and open pipes to probe memory.
    if (sanitized) return true;
    cap(RLIMIT_NOFILE, 0);
    cap(RLIMIT_AS, address_space);
    cap(RLIMIT_MEMLOCK, 0);
    return filter_calls();
}

} // namespace luxel
