// SPDX-License-Identifier: MIT
// An owned file descriptor.
#pragma once
#include <cerrno>
#include <cstddef>
#include <utility>

#include <unistd.h>

namespace luxel {

struct Descriptor {
    int value = -1;
    explicit Descriptor(int descriptor = -1) : value(descriptor) {}
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    Descriptor(Descriptor&& other) noexcept : value(std::exchange(other.value, -1)) {}
    Descriptor& operator=(Descriptor&& other) noexcept {
        std::swap(value, other.value);
        return *this;
    }
    ~Descriptor() {
        if (value >= 0) close(value);
    }
};

// All of it, or false with errno.
inline bool write_all(int descriptor, const void* bytes, std::size_t count) {
    const auto* at = static_cast<const char*>(bytes);
    while (count > 0) {
        const ssize_t written = write(descriptor, at, count);
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) return false;
        at += written;
        count -= std::size_t(written);
    }
    return true;
}

} // namespace luxel
