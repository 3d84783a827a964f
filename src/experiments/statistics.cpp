// SPDX-License-Identifier: MIT
#include "experiments/statistics.h"

#include "core/error.h"
#include "experiments/timing.h"

namespace luxel {

namespace {

// Over the views in which each was measured; all have the same components.
std::optional<OwnResult> mean_own(const std::vector<const ViewResult*>& views, std::size_t index) {
    std::vector<Figures> figures;
    std::string component;
    for (const ViewResult* view : views)
        if (const std::optional<OwnResult>& own = view->rows[index].own)
            figures.push_back(own->figures), component = own->component;
    if (figures.empty()) return std::nullopt;
    const Figures mean = mean_of(figures);
    return OwnResult{component, mean, is_claimed(mean)};
}

// Those in which the row was measured; all where it was in none, as its figures are the baseline's then.
std::vector<const ViewResult*> measured_views(const std::vector<const ViewResult*>& views,
                                              std::size_t index) {
    std::vector<const ViewResult*> measured;
    for (const ViewResult* view : views)
        if (view->rows[index].unmeasured.empty()) measured.push_back(view);
    return measured.empty() ? views : measured;
}

RowResult mean_row(const std::vector<const ViewResult*>& all, std::size_t index) {
    RowResult mean;
    const std::vector<const ViewResult*> views = measured_views(all, index);
    std::vector<Figures> figures;
    std::vector<FrameTime> times;
    std::vector<RowCost> costs;
    double bytes = 0;
    for (const ViewResult* view : views) {
        const RowResult& row = view->rows[index];
        figures.push_back(row.figures);
        times.push_back({row.ms, row.passes});
        costs.push_back(row.cost);
        bytes += double(row.memory_bytes) / double(views.size());
    }
    mean.unmeasured = views.front()->rows[index].unmeasured;
    mean.views = mean.unmeasured.empty() ? int(views.size()) : 0;
    mean.own = mean_own(views, index);
    mean.cost = mean_cost(costs);
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
        mean[i].claimed = mean[i].views > 0 && is_claimed(mean[i].figures);
    }
    return mean;
}

Summary summarize(const std::vector<const ViewResult*>& all, std::size_t row) {
    LUXEL_ASSERT(!all.empty(), "no views");
    const std::vector<const ViewResult*> views = measured_views(all, row);
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
