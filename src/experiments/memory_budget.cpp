// SPDX-License-Identifier: MIT
#include "experiments/memory_budget.h"

#include <fstream>
#include <limits>
#include <string>

#include "core/error.h"

namespace luxel {

namespace {

// Per pixel. A component: fifteen sums in double precision, then mean, variance and four groups in single
// precision, and one more copy in flight. A frame: geometry and light buffers, the picture, the metrics'
// filtered copies, and the truth from fewer samples, ten times as radiance and as display values.
constexpr std::uint64_t component_bytes = 15 * 8 + 6 * 12 + 6 * 12, frame_bytes = 512 + 10 * 2 * 12;

// What the system could give without swapping; unknown systems refuse nothing.
std::uint64_t available_bytes() {
    std::ifstream stream("/proc/meminfo");
    for (std::string name, rest; stream >> name; std::getline(stream, rest)) {
        std::uint64_t kibibytes = 0;
        if (name == "MemAvailable:" && stream >> kibibytes) return kibibytes * 1024;
    }
    return std::numeric_limits<std::uint64_t>::max();
}

} // namespace

void require_memory(int width, int height, std::size_t components) {
    const std::uint64_t needed =
        std::uint64_t(width) * std::uint64_t(height) * (component_bytes * components + frame_bytes);
    const std::uint64_t available = available_bytes();
    constexpr double gibibyte = 1 << 30;
    if (needed > available)
        fail(Fault::resource, "memory: {}x{} pixels need about {:.1f} GiB, {:.1f} GiB are available", width,
             height, double(needed) / gibibyte, double(available) / gibibyte);
}

} // namespace luxel
