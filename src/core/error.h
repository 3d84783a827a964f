// SPDX-License-Identifier: MIT
// The one exception for what the world does wrong. Bugs are LUXEL_ASSERT; the expected is std::optional.
#pragma once
#include <stdexcept>
#include <string>
#include <utility>

#include <fmt/format.h>

namespace luxel {

// The process exit code that an error ends with.
enum class Fault { usage = 2, unsupported = 3, bad_input = 4, resource = 5, io = 6, device_lost = 7 };

// what() is one sentence: "file: place: reason; what to do".
class Error : public std::runtime_error {
public:
    Error(Fault fault, const std::string& sentence) : std::runtime_error(sentence), fault_(fault) {}
    Fault fault() const { return fault_; }

private:
    Fault fault_;
};

// fail(Fault::bad_input, "{}: accessor {} is out of range", path, index)
template <class... Args>
[[noreturn]] void fail(Fault fault, fmt::format_string<Args...> format, Args&&... args) {
    throw Error(fault, fmt::format(format, std::forward<Args>(args)...));
}

[[noreturn]] void assertion_failed(const char* file, int line, const char* condition, const std::string& values);

// Programming errors, always compiled in: LUXEL_ASSERT(a < b, "a={} b={}", a, b).
#define LUXEL_ASSERT(condition, ...)                                                                         \
    do {                                                                                                     \
        if (!(condition))                                                                                    \
            ::luxel::assertion_failed(__FILE__, __LINE__, #condition, ::fmt::format(__VA_ARGS__));           \
    } while (false)

} // namespace luxel
