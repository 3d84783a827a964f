// SPDX-License-Identifier: MIT
#include "experiments/row_cost.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace luxel {

namespace {

// Between neighbors in order, linearly.
double quantile(const std::vector<double>& sorted, double share) {
    const double place = share * double(sorted.size() - 1);
    const std::size_t below = std::size_t(place), above = std::min(below + 1, sorted.size() - 1);
    return std::lerp(sorted[below], sorted[above], place - double(below));
}

} // namespace

Spread spread_of(std::vector<double> ms) {
    LUXEL_ASSERT(!ms.empty(), "no values");
    std::sort(ms.begin(), ms.end());
    return {quantile(ms, 0.5), quantile(ms, 0.25), quantile(ms, 0.75)};
}

RowCost mean_cost(const std::vector<RowCost>& costs) {
    LUXEL_ASSERT(!costs.empty(), "no costs");
    RowCost mean;
    const double share = 1.0 / double(costs.size());
    for (const RowCost& cost : costs) {
        for (Spread RowCost::*part : {&RowCost::base, &RowCost::technique})
            for (double Spread::*value : {&Spread::ms, &Spread::low, &Spread::high})
                (mean.*part).*value += share * (cost.*part).*value;
        mean.preparation += share * cost.preparation;
    }
    return mean;
}

} // namespace luxel
