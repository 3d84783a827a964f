// SPDX-License-Identifier: MIT
// What the reproductions of theses share: rows of techniques over views of scenes.
#pragma once
#include "experiments/reproduce.h"

namespace luxel {

constexpr int fewest_timed_frames = 3; // of which a median leaves an outlier out
constexpr const char* not_measurable = "not measurable";

// All views of all scenes, each with its rows in the order of `uses` behind the baseline; `sink` sees their
// pictures.
std::vector<ViewResult> reproduce_views(const ReproduceSettings& settings, gpu::Gpu& gpu,
                                        const std::vector<std::string>& uses,
                                        const std::vector<std::string>& scenes, const TruthSettings& truth,
                                        Reproduction& out, const PictureSink& sink = {});

// None where a view has none.
template <class Value>
std::optional<std::vector<double>> over_all(const std::vector<ViewResult>& views, Value&& value) {
    std::vector<double> values;
    for (const ViewResult& view : views) {
        const std::optional<double> one = value(view);
        if (!one) return std::nullopt;
        values.push_back(*one);
    }
    return values;
}

// Passes whose names begin with one prefix, but not with the other.
struct PassTimes {
    std::string_view with, without;
    std::optional<double> of(const std::vector<gpu::PassTime>& passes) const;
};
// The median over views of one row's own time over another's. Every claim is that it takes longer.
void add_time_ratio(Reproduction& out, const ReproduceSettings& settings,
                    const std::vector<ViewResult>& views, const PassTimes& times, const std::string& subject,
                    const std::string& claim, std::size_t row, std::size_t base);

double mean_delta(const std::vector<ViewResult>& views, std::size_t row);
// The claim that the first has the lower error.
void add_order_of(Reproduction& out, const std::string& subject, double first, double second);

// What was run, in words.
std::string setting(const std::vector<ViewResult>& views, const std::vector<std::string>& scenes,
                    const ReproduceSettings& settings);
std::string about_times(const ReproduceSettings& settings);

} // namespace luxel
