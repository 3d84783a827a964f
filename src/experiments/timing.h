// SPDX-License-Identifier: MIT
// Frame times that a machine's hiccups do not move.
#pragma once
#include <optional>
#include <string_view>
#include <vector>

#include "gpu/recorder.h"

namespace luxel {

struct FrameTime {
    double ms = 0;                     // median over frames of the sum of the passes
    std::vector<gpu::PassTime> passes; // median of each pass; their sum need not be ms
    double least = 0, most = 0;        // over frames, of the sum of the passes
};

// Frames have the same passes in the same order.
FrameTime median_time(const std::vector<std::vector<gpu::PassTime>>& frames);

// Mean of each pass over views; a pass that a view lacks counts as 0 there.
FrameTime mean_time(const std::vector<FrameTime>& times);

// Sum of the passes inside the recorder's scope of that name; none where there are no such passes, or where
// the clock saw nothing of them.
std::optional<double> time_in_scope(const std::vector<gpu::PassTime>& passes, std::string_view scope);

double median(std::vector<double> values);

} // namespace luxel
