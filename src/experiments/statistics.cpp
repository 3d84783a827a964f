// SPDX-License-Identifier: MIT
#include "experiments/statistics.h"

#include "core/error.h"
#include "experiments/timing.h"

namespace luxel {

namespace {

RowResult mean_row(const std::vector<const ViewResult*>& views, std::size_t index) {
    RowResult mean;
    std::vector<Figures> figures;
    std::vector<FrameTime> times;
    double bytes = 0;
    for (const ViewResult* view : views) {
        const RowResult& row = view->rows[index];
        figures.push_back(row.figures);
        times.push_back({row.ms, row.passes});
        bytes += double(row.memory_bytes) / double(views.size());
    }
    const FrameTime time = mean_time(times);
    mean.figures = mean_of(figures);
    mean.ms = time.ms;
    mean.passes = time.passes;
    mean.memory_bytes = std::uint64_t(bytes);
    return mean;
}

} // namespace

double mean_noise(const std::vector<const ViewResult*>& views) {
    double mean = 0;
    for (const ViewResult* view : views) mean += view->noise / double(views.size());
    return mean;
}

std::vector<RowResult> mean_rows(const std::vector<const ViewResult*>& views) {
    LUXEL_ASSERT(!views.empty(), "no views");
    std::vector<RowResult> mean;
    for (std::size_t i = 0; i < views[0]->rows.size(); ++i) {
        mean.push_back(mean_row(views, i));
        mean[i].claimed = is_claimed(mean[i].figures);
    }
    return mean;
}

Summary summarize(const std::vector<const ViewResult*>& views, std::size_t row) {
    LUXEL_ASSERT(!views.empty(), "no views");
    Summary s;
    s.views = int(views.size());
    const double share = 1.0 / double(views.size());
    std::vector<double> gains;
    for (const ViewResult* view : views) {
        const Figures& f = view->rows[row].figures;
        gains.push_back(f.gain);
        s.positive += f.gain > 0 ? share : 0;
        s.claimed += view->rows[row].claimed ? share : 0;
        s.mean_gain += f.gain * share;
        s.rho_before += view->rows[0].figures.rho * share;
        s.rho_after += f.rho * share;
        s.improved += f.improved * share;
        s.tied += f.tied * share;
    }
    s.median_gain = median(std::move(gains));
    return s;
}

} // namespace luxel
