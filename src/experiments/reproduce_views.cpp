// SPDX-License-Identifier: MIT
#include "experiments/reproduce_views.h"

#include <algorithm>

#include <fmt/ranges.h>

namespace luxel {

std::vector<ViewResult> reproduce_views(const ReproduceSettings& settings, gpu::Gpu& gpu,
                                        const std::vector<std::string>& uses,
                                        const std::vector<std::string>& scenes, const TruthSettings& truth,
                                        Reproduction& out) {
    Experiment experiment;
    experiment.name = "reproduce";
    experiment.uses = uses;
    experiment.truth = truth;
    experiment.timed_frames = settings.timed_frames;
    for (const std::string& source : scenes) {
        SceneEntry entry;
        entry.name = entry.source = entry.file = entry.group = source;
        entry.load.strict = settings.strict;
        const ViewChoice choice = {.drawn = settings.views_per_scene, .seed = std::uint32_t(truth.seed)};
        entry.views = {{.choice = choice, .width = settings.width, .height = settings.height}};
        experiment.scenes.push_back(entry);
    }
    RunOptions options = settings.run;
    options.gpu = &gpu;
    options.pictures = [](const SceneEntry&, const ViewPictures&) { return nullptr; };
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
