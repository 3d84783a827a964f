// SPDX-License-Identifier: MIT
#include "core/error.h"

#include <cstdio>
#include <cstdlib>

namespace luxel {

void assertion_failed(const char* file, int line, const char* condition, const std::string& values) {
    fmt::print(stderr, "luxel: bug: {}:{}: {} ({})\n", file, line, condition, values);
    std::abort();
}

} // namespace luxel
