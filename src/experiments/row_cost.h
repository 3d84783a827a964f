// SPDX-License-Identifier: MIT
// What a row costs: the frame that it adds to, its own passes, and what comes before its second frame.
#pragma once
#include <vector>

namespace luxel {

// Milliseconds over the timed frames: the median, and the quartiles below and above it.
struct Spread {
    double ms = 0, low = 0, high = 0;
};
Spread spread_of(std::vector<double> ms); // of one value at least

struct RowCost {
    Spread base;      // the view's frame without any technique, the same for every row
    Spread technique; // GPU time of what the row adds to it, never below 0
    double preparation =
        0; // seconds of its first frame beyond a later one's: pipelines, tables, kept captures
};
RowCost mean_cost(const std::vector<RowCost>& costs); // of one at least

} // namespace luxel
