// SPDX-License-Identifier: MIT
// Our side of the decoding process. It is a program of its own, not a fork: a fork of a process with threads
// may do next to nothing safely.
#include "core/decode_process.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <optional>
#include <system_error>

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/codec.h"
#include "core/decode_message.h"
#include "core/descriptor.h"
#include "core/error.h"
#include "core/sandbox.h"

extern char** environ; // POSIX declares it nowhere

namespace luxel::codec {
namespace {

using Clock = std::chrono::steady_clock;
constexpr auto time_limit = std::chrono::seconds(60);

[[noreturn]] void fail_system(const char* what) {
    fail(Fault::resource, "cannot decode: {}: {}", what, std::strerror(errno));
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
    // The images, each behind its length.
    explicit Decoder(std::span<const std::span<const std::uint8_t>> images) {
        const Descriptor input(memfd_create("luxel-image", MFD_CLOEXEC));
        if (input.value < 0) fail_system("memory file");
        for (const std::span<const std::uint8_t> bytes : images) {
            const std::uint64_t length = bytes.size();
            if (!write_all(input.value, &length, sizeof length) ||
                !write_all(input.value, bytes.data(), bytes.size()))
                fail_system("write");
        }
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

    Decoded next() {
        deadline_ = Clock::now() + time_limit;
        return receive([this](void* target, std::size_t count) { read(target, count); });
    }

private:
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
            fail(Fault::bad_input, "decoding takes more than {} s of processor time",
                 sandbox_processor_seconds);
        if (WIFSIGNALED(status))
            fail(Fault::bad_input, "the decoder stopped at this file ({})", strsignal(WTERMSIG(status)));
        fail(Fault::bad_input, "the decoder stopped at this file (exit {})", WEXITSTATUS(status));
    }

    pid_t pid_ = -1;
    Descriptor output_;
    Clock::time_point deadline_;
};

} // namespace

std::vector<DecodedOrError> decode_apart(std::span<const std::span<const std::uint8_t>> images) {
    std::vector<DecodedOrError> results;
    std::optional<Decoder> decoder;
    while (results.size() < images.size()) {
        if (!decoder) decoder.emplace(images.subspan(results.size()));
        try {
            results.emplace_back(decoder->next());
        } catch (const Error& error) {
            // What a process says after a fault counts for nothing: the next image has a new one.
            if (error.fault() != Fault::bad_input) throw;
            results.emplace_back(error);
            decoder.reset();
        }
    }
    return results;
}

Decoded decode_apart(std::span<const std::uint8_t> bytes) {
    DecodedOrError result = std::move(decode_apart(std::span(&bytes, 1)).front());
    if (const Error* error = std::get_if<Error>(&result)) throw *error;
    return std::move(std::get<Decoded>(result));
}

} // namespace luxel::codec
