// SPDX-License-Identifier: MIT
// Data-parallel loops over TBB; the result must not depend on how the range is cut.
#pragma once
#include <cstddef>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace luxel {

// body(i) for every i in [0, count).
template <class Body> void parallel_for(std::size_t count, std::size_t grain, Body&& body) {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, grain), [&](const auto& range) {
        for (std::size_t i = range.begin(); i != range.end(); ++i) body(i);
    });
}

} // namespace luxel
