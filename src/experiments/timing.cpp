// SPDX-License-Identifier: MIT
#include "experiments/timing.h"

#include <algorithm>

#include "core/error.h"

namespace luxel {

double median(std::vector<double> values) {
    LUXEL_ASSERT(!values.empty(), "no values");
    std::sort(values.begin(), values.end());
    const std::size_t middle = values.size() / 2;
    return values.size() % 2 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

std::optional<double> time_in_scope(const std::vector<gpu::PassTime>& passes, std::string_view scope) {
    double sum = 0;
    for (const gpu::PassTime& pass : passes)
        if (pass.name.starts_with(fmt::format("{}: ", scope))) sum += pass.ms;
    return sum > 0 ? std::optional(sum) : std::nullopt;
}

FrameTime median_time(const std::vector<std::vector<gpu::PassTime>>& frames) {
    FrameTime time;
    std::vector<double> sums;
    for (const auto& frame : frames) {
        LUXEL_ASSERT(frame.size() == frames[0].size(), "passes {} and {}", frame.size(), frames[0].size());
        double sum = 0;
        for (const gpu::PassTime& pass : frame) sum += pass.ms;
        sums.push_back(sum);
    }
    time.ms = median(sums);
    const auto [least, most] = std::minmax_element(sums.begin(), sums.end());
    time.least = *least, time.most = *most;
    for (std::size_t i = 0; i < frames[0].size(); ++i) {
        std::vector<double> values;
        for (const auto& frame : frames) values.push_back(frame[i].ms);
        time.passes.push_back({frames[0][i].name, median(values)});
    }
    return time;
}

FrameTime mean_time(const std::vector<FrameTime>& times) {
    FrameTime mean;
    for (const FrameTime& time : times) {
        mean.ms += time.ms / double(times.size());
        mean.least += time.least / double(times.size()), mean.most += time.most / double(times.size());
        // The n-th pass of a name adds to the n-th entry of that name.
        std::vector<bool> used(mean.passes.size(), false);
        for (const gpu::PassTime& pass : time.passes) {
            std::size_t i = 0;
            while (i < used.size() && (used[i] || mean.passes[i].name != pass.name)) ++i;
            if (i == used.size()) mean.passes.push_back({pass.name, 0.0}), used.push_back(false);
            used[i] = true;
            mean.passes[i].ms += pass.ms / double(times.size());
        }
    }
    return mean;
}

} // namespace luxel
