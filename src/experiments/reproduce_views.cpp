// SPDX-License-Identifier: MIT
#include "experiments/reproduce_views.h"

#include <algorithm>

#include <fmt/ranges.h>

#include "experiments/timing.h"

namespace luxel {

std::vector<ViewResult> reproduce_views(const ReproduceSettings& settings, gpu::Gpu& gpu,
                                        const std::vector<std::string>& uses,
                                        const std::vector<std::string>& scenes, const TruthSettings& truth,
                                        Reproduction& out, const PictureSink& sink) {
    Experiment experiment;
    experiment.name = "reproduce";
    experiment.uses = uses;
    experiment.truth = truth;
    experiment.timed_frames = settings.timed_frames;
    for (const std::string& source : scenes) {
        SceneEntry entry;
        entry.name = entry.source = entry.file = entry.group = source;
        entry.load.strict = settings.strict, entry.load.data = settings.data;
        const ViewChoice choice = {.drawn = settings.views_per_scene, .seed = std::uint32_t(truth.seed)};
        entry.views = {{.choice = choice, .width = settings.width, .height = settings.height}};
        experiment.scenes.push_back(entry);
    }
    RunOptions options = settings.run;
    options.gpu = &gpu;
    options.pictures = [&](const SceneEntry&, const ViewPictures& pictures) -> nlohmann::ordered_json {
        return sink ? sink(pictures) : nullptr;
    };
    const ExperimentResult result = run_experiment(experiment, options);

    std::vector<ViewResult> views;
    for (const SceneResult& scene : result.scenes) {
        views.insert(views.end(), scene.views.begin(), scene.views.end());
        for (const std::string& warning : scene.warnings)
            if (std::find(out.warnings.begin(), out.warnings.end(), warning) == out.warnings.end())
                out.warnings.push_back(warning);
    }
    return views;
}

std::optional<double> PassTimes::of(const std::vector<gpu::PassTime>& passes) const {
    double sum = 0;
    for (const gpu::PassTime& pass : passes)
        if (pass.name.starts_with(with) && (without.empty() || !pass.name.starts_with(without)))
            sum += pass.ms;
    return sum > 0 ? std::optional(sum) : std::nullopt;
}

void add_time_ratio(Reproduction& out, const ReproduceSettings& settings,
                    const std::vector<ViewResult>& views, const PassTimes& times, const std::string& subject,
                    const std::string& claim, std::size_t row, std::size_t base) {
    const auto ratios = over_all(views, [&](const ViewResult& v) -> std::optional<double> {
        const auto ms = times.of(v.rows[row].passes), of = times.of(v.rows[base].passes);
        return ms && of ? std::optional(*ms / *of) : std::nullopt;
    });
    Statement statement = {subject, claim, not_measurable, {}, std::nullopt};
    if (ratios) {
        const double ratio = median(*ratios);
        statement.values = {ratio};
        statement.measured = fmt::format("{:.2f}", ratio);
        if (settings.timed_frames >= fewest_timed_frames) statement.holds = ratio > 1;
    }
    out.statements.push_back(statement);
}

double mean_delta(const std::vector<ViewResult>& views, std::size_t row) {
    double mean = 0;
    for (const ViewResult& view : views) mean += view.rows[row].figures.delta / double(views.size());
    return mean;
}

void add_order_of(Reproduction& out, const std::string& subject, double first, double second) {
    out.statements.push_back({subject,
                              "lower error",
                              fmt::format("{:.4f} against {:.4f}", first, second),
                              {first, second},
                              first < second});
}

std::string setting(const std::vector<ViewResult>& views, const std::vector<std::string>& scenes,
                    const ReproduceSettings& settings) {
    return fmt::format("{} views of {} at {}x{}, {} samples a pixel for the truth", views.size(),
                       fmt::join(scenes, ", "), settings.width, settings.height, settings.truth.spp);
}

std::string about_times(const ReproduceSettings& settings) {
    return fmt::format(
        "times are sums of a technique's own passes, each the median of {} frames in which the "
        "rows take turns{}",
        settings.timed_frames, settings.timed_frames < fewest_timed_frames ? ", too few for a verdict" : "");
}

} // namespace luxel
