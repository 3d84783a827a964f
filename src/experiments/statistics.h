// SPDX-License-Identifier: MIT
// What many views say together about a row.
#pragma once
#include <string>
#include <vector>

#include "experiments/evaluation.h"

namespace luxel {

// Means over views, per row, each over those in which it was measured. `views` must not be empty.
std::vector<RowResult> mean_rows(const std::vector<const ViewResult*>& views);
double mean_noise(const std::vector<const ViewResult*>& views);

// One row over the views of a group of scenes.
struct Summary {
    std::string group, label;
    int views = 0; // in which the row was measured; where there are none, it has no summary
    double positive = 0, claimed = 0; // shares of views: gain above 0, gain claimed
    double mean_gain = 0, median_gain = 0;
    double rho_before = 0, rho_after = 0; // mean correlation of the baseline and of the row
    double improved = 0, tied = 0;        // mean shares of pixels
};
Summary summarize(const std::vector<const ViewResult*>& views, std::size_t row);

} // namespace luxel
