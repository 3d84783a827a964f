// SPDX-License-Identifier: MIT
// Both sides of the decoding process. It is a program of its own, not a fork: a fork of a process with
// threads may do next to nothing safely.
#include "core/decode_process.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <new>
#include <system_error>

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/codec.h"
#include "core/decode_message.h"
#include "core/descriptor.h"
#include "core/error.h"

extern char** environ; // POSIX declares it nowhere

namespace luxel::codec {
namespace {

using Clock = std::chrono::steady_clock;
constexpr auto time_limit = std::chrono::seconds(60);
constexpr rlim_t processor_seconds = 30;
constexpr rlim_t address_space = rlim_t(4) << 30;

[[noreturn]] void fail_system(const char* what) {
    fail(Fault::resource, "cannot decode: {}: {}", what, std::strerror(errno));
}

void write_all(int descriptor, const void* bytes, std::size_t count) {
    const auto* at = static_cast<const char*>(bytes);
    while (count > 0) {
        const ssize_t written = write(descriptor, at, count);
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) fail_system("write");
        at += written;
        count -= std::size_t(written);
    }
}

std::filesystem::path decoder_path() {
    std::error_code error;
    const auto self = std::filesystem::read_symlink("/proc/self/exe", error);
    const auto path = self.parent_path() / "luxel-decode";
    if (error || access(path.c_str(), X_OK) != 0)
        fail(Fault::io, "cannot decode: {} is missing; it is installed beside the program", path.string());
    return path;
}

// A running decoder, ended and reaped with the object.
class Decoder {
public:
    explicit Decoder(std::span<const std::uint8_t> bytes) {
        const Descriptor input(memfd_create("luxel-image", MFD_CLOEXEC));
        if (input.value < 0) fail_system("memory file");
        write_all(input.value, bytes.data(), bytes.size());
        lseek(input.value, 0, SEEK_SET);
        int ends[2];
        if (pipe2(ends, O_CLOEXEC) != 0) fail_system("pipe");
        output_ = Descriptor(ends[0]);
        const Descriptor child_end(ends[1]);
        spawn(input.value, child_end.value);
    }
    Decoder(const Decoder&) = delete;
    Decoder& operator=(const Decoder&) = delete;
    ~Decoder() { end(); }

    // Exactly count bytes of the answer, or an error that says how the decoder ended.
    void read(void* target, std::size_t count) {
        auto* at = static_cast<char*>(target);
        while (count > 0) {
            const auto left =
                std::chrono::duration_cast<std::chrono::milliseconds>(deadline_ - Clock::now()).count();
            pollfd waiting{output_.value, POLLIN, 0};
            const int ready = left > 0 ? poll(&waiting, 1, int(left)) : 0;
            if (ready == 0) fail(Fault::bad_input, "decoding takes more than {} s", time_limit.count());
            const ssize_t got = ready > 0 ? ::read(output_.value, at, count) : -1;
            if (got < 0 && errno == EINTR) continue;
            if (got < 0) fail_system("read");
            if (got == 0) fail_early();
            at += got;
            count -= std::size_t(got);
        }
    }

private:
    void spawn(int input, int output) {
        const std::string path = decoder_path().string();
        std::string name = "luxel-decode";
        char* arguments[] = {name.data(), nullptr};
        posix_spawn_file_actions_t actions;
        posix_spawn_file_actions_init(&actions);
        posix_spawn_file_actions_adddup2(&actions, input, STDIN_FILENO);
        posix_spawn_file_actions_adddup2(&actions, output, STDOUT_FILENO);
        posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
        const int error = posix_spawn(&pid_, path.c_str(), &actions, nullptr, arguments, environ);
        posix_spawn_file_actions_destroy(&actions);
        if (error != 0) {
            pid_ = -1;
            fail(Fault::resource, "cannot decode: {}: {}", path, std::strerror(error));
        }
    }

    // Its wait status; 0 where it was reaped before.
    int end() {
        int status = 0;
        if (pid_ > 0) {
            kill(pid_, SIGKILL);
            while (waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
            }
            pid_ = -1;
        }
        return status;
    }

    [[noreturn]] void fail_early() {
        const int status = end();
        if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU)
            fail(Fault::bad_input, "decoding takes more than {} s of processor time", processor_seconds);
        if (WIFSIGNALED(status))
            fail(Fault::bad_input, "the decoder stopped at this file ({})", strsignal(WTERMSIG(status)));
        fail(Fault::bad_input, "the decoder stopped at this file (exit {})", WEXITSTATUS(status));
    }

    pid_t pid_ = -1;
    Descriptor output_;
    Clock::time_point deadline_ = Clock::now() + time_limit;
};

void cap(decltype(RLIMIT_AS) resource, rlim_t most) {
    const rlimit limit{most, most};
    if (setrlimit(resource, &limit) != 0) _exit(1);
}

// No descriptor can be opened any more: no files, no sockets.
void give_up_rights() {
    if (close_range(3, ~0U, 0) != 0) _exit(1);
    cap(RLIMIT_FSIZE, 0);
    cap(RLIMIT_CORE, 0);
    cap(RLIMIT_CPU, processor_seconds);
    // Sanitizers reserve terabytes of addresses and open pipes to probe memory.
#ifndef __SANITIZE_ADDRESS__
    cap(RLIMIT_NOFILE, 0);
    cap(RLIMIT_AS, address_space);
#endif
}

std::vector<std::uint8_t> read_input() {
    std::vector<std::uint8_t> bytes;
    std::size_t filled = 0;
    for (ssize_t got = 1; got > 0;) {
        bytes.resize(std::max<std::size_t>(filled + (1 << 20), filled + filled / 2));
        got = read(STDIN_FILENO, bytes.data() + filled, bytes.size() - filled);
        filled += got > 0 ? std::size_t(got) : 0;
    }
    bytes.resize(filled);
    return bytes;
}

Decoded decode(std::span<const std::uint8_t> bytes) {
    switch (format_of(bytes)) {
    case Format::exr:
        return decode_exr(bytes);
    case Format::png:
        return decode_png(bytes);
    case Format::jpeg:
        return decode_jpeg(bytes);
    case Format::radiance:
        return ExrFile{.layers = {{"", decode_radiance(bytes)}}, .metadata = {}, .remark = {}};
    case Format::unknown:
        break;
    }
    fail(Fault::bad_input, "not OpenEXR, Radiance, PNG or JPEG");
}

} // namespace

Decoded decode_apart(std::span<const std::uint8_t> bytes) {
    Decoder decoder(bytes);
    return receive([&](void* target, std::size_t count) { decoder.read(target, count); });
}

void decode_and_exit() {
    give_up_rights();
    const Put put = [](const void* bytes, std::size_t count) { write_all(STDOUT_FILENO, bytes, count); };
    try {
        const Decoded decoded = decode(read_input());
        send(decoded, put);
    } catch (const std::bad_alloc&) {
        send_refusal("decoding takes more memory than allowed", put);
    } catch (const std::exception& error) {
        send_refusal(error.what(), put);
    }
    // Nothing is left to flush; leak checkers could not open what they need.
    _exit(0);
}

} // namespace luxel::codec
