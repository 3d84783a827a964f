// SPDX-License-Identifier: MIT
// Files read safely and written whole, on POSIX calls.
#include "core/file.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <random>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/descriptor.h"
#include "core/error.h"

namespace luxel {
namespace {

// O_NONBLOCK: opening a FIFO for reading returns at once instead of waiting for a writer.
constexpr int read_flags = O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC;

std::vector<std::uint8_t> read_regular(int descriptor, const std::string& name, std::uint64_t limit) {
    struct stat status {};
    if (fstat(descriptor, &status) != 0) fail(Fault::io, "{}: {}", name, std::strerror(errno));
    if (!S_ISREG(status.st_mode)) fail(Fault::bad_input, "{}: not a regular file", name);
    const auto size = std::uint64_t(status.st_size);
    if (size > limit) fail(Fault::bad_input, "{}: {} bytes, more than the limit of {}", name, size, limit);

    std::vector<std::uint8_t> bytes(size);
    std::size_t filled = 0;
    while (filled < bytes.size()) {
        const ssize_t count = read(descriptor, bytes.data() + filled, bytes.size() - filled);
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) fail(Fault::io, "{}: {}", name, std::strerror(errno));
        if (count == 0) break; // it shrank while being read
        filled += std::size_t(count);
    }
    bytes.resize(filled);
    return bytes;
}

void sync(const std::filesystem::path& path, const std::filesystem::path& target) {
    const Descriptor descriptor(open(path.c_str(), O_RDONLY | O_CLOEXEC));
    if (descriptor.value < 0 || fsync(descriptor.value) != 0)
        fail(Fault::io, "{}: cannot write: {}", target.string(), std::strerror(errno));
}

} // namespace

std::vector<std::uint8_t> read_file(const std::filesystem::path& file, std::uint64_t limit) {
    const Descriptor descriptor(open(file.c_str(), read_flags));
    if (descriptor.value < 0) fail(Fault::io, "{}: cannot open: {}", file.string(), std::strerror(errno));
    return read_regular(descriptor.value, file.string(), limit);
}

std::optional<std::vector<std::uint8_t>> Folder::read(std::string_view relative, std::uint64_t limit) const {
    const std::string name = (root_ / relative).string();
    if (relative.empty() || relative.front() == '/' || relative.find('\0') != std::string_view::npos)
        fail(Fault::bad_input, "{}: \"{}\" is no path within this folder", root_.string(), relative);
    Descriptor at(open(root_.empty() ? "." : root_.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC));
    if (at.value < 0) fail(Fault::io, "{}: cannot open: {}", root_.string(), std::strerror(errno));

    // One component at a time from the folder's own descriptor, never through a link: the path cannot leave
    // the folder, whatever is renamed meanwhile.
    while (!relative.empty()) {
        const std::size_t slash = std::min(relative.find('/'), relative.size());
        const std::string component(relative.substr(0, slash));
        const bool last = slash == relative.size();
        relative.remove_prefix(last ? slash : slash + 1);
        if (component == "..") fail(Fault::bad_input, "{}: the path leaves the folder", name);
        if (component == "." || (component.empty() && !last)) continue;

        const int flags = last ? read_flags : O_PATH | O_DIRECTORY | O_CLOEXEC;
        Descriptor next(openat(at.value, component.c_str(), flags | O_NOFOLLOW));
        if (next.value < 0) {
            const int reason = errno;
            struct stat status {};
            if (fstatat(at.value, component.c_str(), &status, AT_SYMLINK_NOFOLLOW) == 0 &&
                S_ISLNK(status.st_mode))
                fail(Fault::bad_input, "{}: \"{}\" is a symbolic link; links are not followed", name,
                     component);
            if (reason == ENOENT || reason == ENOTDIR) return std::nullopt;
            if (reason == ENXIO) fail(Fault::bad_input, "{}: not a regular file", name);
            fail(Fault::io, "{}: cannot open: {}", name, std::strerror(reason));
        }
        at = std::move(next);
    }
    return read_regular(at.value, name, limit);
}

void write_atomically(const std::filesystem::path& file,
                      const std::function<void(const std::filesystem::path&)>& write) {
    // A rename would replace a device such as /dev/null by a file.
    std::error_code ignored;
    if (std::filesystem::exists(file, ignored) && !std::filesystem::is_regular_file(file, ignored))
        fail(Fault::io, "{}: cannot write: not a regular file", file.string());
    const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
    std::random_device random;
    const std::filesystem::path temporary =
        folder / fmt::format(".{}.{:08x}{:08x}", file.filename().string(), random(), random());

    try {
        write(temporary);
        sync(temporary, file);
        if (rename(temporary.c_str(), file.c_str()) != 0)
            fail(Fault::io, "{}: cannot write: {}", file.string(), std::strerror(errno));
    } catch (...) {
        std::filesystem::remove(temporary, ignored);
        throw;
    }
    sync(folder, file);
}

void write_file(const std::filesystem::path& file, std::span<const std::uint8_t> bytes) {
    write_atomically(file, [&](const std::filesystem::path& temporary) {
        const Descriptor descriptor(open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
        std::size_t written = 0;
        while (descriptor.value >= 0 && written < bytes.size()) {
            const ssize_t count = ::write(descriptor.value, bytes.data() + written, bytes.size() - written);
            if (count < 0 && errno == EINTR) continue;
            if (count < 0) break;
            written += std::size_t(count);
        }
        if (descriptor.value < 0 || written < bytes.size())
            fail(Fault::io, "{}: cannot write: {}", file.string(), std::strerror(errno));
    });
}

void write_file(const std::filesystem::path& file, std::string_view text) {
    write_file(file, std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
}

} // namespace luxel
