// SPDX-License-Identifier: MIT
// An owned file descriptor.
#pragma once
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

} // namespace luxel
