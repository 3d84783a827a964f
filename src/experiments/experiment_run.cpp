// SPDX-License-Identifier: MIT
#include "experiments/experiment_run.h"

#include <algorithm>
#include <chrono>
#include <map>
#include <optional>

#include "core/error.h"
#include "core/progress.h"
#include "experiments/journal.h"
#include "experiments/judge.h"
#include "experiments/memory_budget.h"
#include "experiments/picture_row.h"

namespace luxel {

namespace {

using Clock = std::chrono::steady_clock;

// How far a run is, in pixels of views; what was finished before it began does not count.
class Work {
public:
    Work(const Experiment& experiment, const RunOptions& options)
        : progress_(experiment.name, options.quiet), seconds_(options.seconds) {
        for (const SceneEntry& entry : experiment.scenes)
            for (const ViewGroup& group : entry.views) left_ += expected(group);
    }
    // The number of a group's views is known for sure once its scene is loaded.
    void begin_group(const ViewGroup& group, std::size_t views) {
        left_ += double(views) * pixels(group) - expected(group);
    }
    void skip(const ViewTask& task) { left_ -= pixels(task); }
    void done(const ViewTask& task) {
        left_ -= pixels(task), done_ += pixels(task);
        progress_.update(done_ / std::max(done_ + left_, 1.0));
    }
    void finish() { progress_.finish(); }
    bool out_of_time() const {
        return seconds_ > 0 && std::chrono::duration<double>(Clock::now() - start_).count() > seconds_;
    }

private:
    template <class Sized> static double pixels(const Sized& sized) {
        return double(sized.width) * double(sized.height);
    }
    static double expected(const ViewGroup& group) {
        const ViewChoice& choice = group.choice;
        const std::size_t views =
            choice.names.empty() ? std::size_t(std::max(choice.drawn, 1)) : choice.names.size();
        return double(views) * pixels(group);
    }
    Progress progress_;
    double seconds_, left_ = 0, done_ = 0;
    Clock::time_point start_ = Clock::now();
};

// Views in order, their names unique within the scene.
std::vector<ViewTask> tasks_of(const Experiment& experiment, const SceneEntry& entry, const RayCaster& rays,
                               Work& work) {
    std::vector<ViewTask> tasks;
    std::vector<Camera> cameras;
    for (const ViewGroup& group : entry.views) {
        const std::vector<Camera> chosen = choose_views(rays, group.choice);
        work.begin_group(group, chosen.size());
        for (const Camera& camera : chosen) {
            cameras.push_back(camera);
            tasks.push_back({camera, group.width, group.height, experiment.timed_frames});
        }
    }
    make_names_unique(cameras);
    for (std::size_t i = 0; i < tasks.size(); ++i) tasks[i].camera.name = cameras[i].name;
    for (const std::string& use : experiment.uses)
        if (is_picture_use(use)) require_pictures(parse_picture_use(use), cameras);
    return tasks;
}

void require_memory_for(const Experiment& experiment) {
    for (const SceneEntry& entry : experiment.scenes)
        for (const ViewGroup& group : entry.views)
            require_memory(group.width, group.height, experiment.truth.components.size() + 2);
}

void warn(const RunOptions& options, const std::vector<std::string>& warnings) {
    if (options.warn) options.warn(warnings);
}

// All of a run that outlives a scene.
struct Run {
    const Experiment& experiment;
    const RunOptions& options;
    gpu::Gpu& gpu;
    const Journal& journal;
    Work& work;
    ExperimentResult& result;
    std::size_t reused = 0;
};

void run_scene(Run& run, const SceneEntry& entry, SceneResult& result) {
    const Scene scene = load_scene(entry.file, entry.load);
    warn(run.options, scene.warnings);
    result.warnings = scene.warnings;
    const Scene truth_scene = reference_scene(scene, entry.frame, run.experiment.truth.true_environment);
    const RayCaster rays(truth_scene);
    const std::uint64_t scene_key = stage_key(scene);

    // The scene goes to the GPU when there is a first view to render.
    std::optional<Renderer> renderer;
    for (const ViewTask& task : tasks_of(run.experiment, entry, rays, run.work)) {
        const std::string key =
            view_key(run.experiment, entry, scene_key, task, run.result.rows, run.gpu.device());
        if (std::optional<ViewResult> finished = run.journal.find(key, task)) {
            result.views.push_back(std::move(*finished));
            run.work.skip(task), ++run.reused;
            continue;
        }
        if (run.work.out_of_time()) {
            run.work.skip(task), ++run.result.missing;
            continue;
        }
        if (!renderer) {
            renderer.emplace(run.gpu, scene, entry.frame);
            std::vector<TechniqueRow> rows = parse_uses(run.experiment.uses);
            warm_up(*renderer, task, rows);
        }
        std::vector<TechniqueRow> rows = parse_uses(run.experiment.uses);
        const auto sink = [&](const ViewPictures& p) { return run.options.pictures(entry, p); };
        result.views.push_back(
            evaluate_view({*renderer, rays, run.options.cache}, task, run.experiment.truth, rows, sink));
        run.journal.store(key, run.result.rows, result.views.back());
        run.work.done(task);
    }

    std::vector<std::string> of_truths;
    for (const ViewResult& view : result.views)
        of_truths.insert(of_truths.end(), view.warnings.begin(), view.warnings.end());
    warn(run.options, of_truths);
    result.warnings.insert(result.warnings.end(), of_truths.begin(), of_truths.end());
}

// Groups in order of appearance, then all together where there are several.
std::vector<Summary> summaries(const ExperimentResult& result) {
    std::vector<std::pair<std::string, std::vector<const ViewResult*>>> groups;
    std::vector<const ViewResult*> all;
    for (std::size_t s = 0; s < result.scenes.size(); ++s) {
        const std::string& name = result.experiment.scenes[s].group;
        auto group =
            std::find_if(groups.begin(), groups.end(), [&](const auto& g) { return g.first == name; });
        if (group == groups.end()) group = groups.insert(groups.end(), {name, {}});
        for (const ViewResult& view : result.scenes[s].views)
            group->second.push_back(&view), all.push_back(&view);
    }
    if (groups.size() > 1) groups.emplace_back("all", std::move(all));

    std::vector<Summary> summary;
    for (const auto& [name, views] : groups)
        for (std::size_t row = 1; row < result.rows.size() && !views.empty(); ++row) {
            summary.push_back(summarize(views, row));
            summary.back().group = name;
            summary.back().label = result.rows[row].label;
        }
    return summary;
}

void add_means(ExperimentResult& result) {
    std::vector<const ViewResult*> all;
    for (SceneResult& scene : result.scenes) {
        std::vector<const ViewResult*> views;
        for (const ViewResult& view : scene.views) views.push_back(&view), all.push_back(&view);
        if (views.empty()) continue;
        scene.mean = mean_rows(views);
        scene.mean_noise = mean_noise(views);
    }
    if (all.empty()) return;
    result.mean = mean_rows(all);
    result.mean_noise = mean_noise(all);
    result.summary = summaries(result);
}

} // namespace

ExperimentResult run_experiment(const Experiment& experiment, const RunOptions& options) {
    // The device first: a machine without one should say so before minutes of path tracing.
    require_memory_for(experiment);
    require_judge(experiment.truth);
    ExperimentResult result;
    result.experiment = experiment;
    for (TechniqueRow& row : parse_uses(experiment.uses))
        result.rows.push_back({std::move(row.label), std::move(row.name), std::move(row.parameters)});
    std::optional<gpu::Gpu> own;
    if (!options.gpu) own.emplace(gpu::GpuOptions{.device = options.device});
    gpu::Gpu& gpu = options.gpu ? *options.gpu : *own;
    result.device = gpu.device();

    const Journal journal(options.journal);
    Work work(experiment, options);
    Run run{experiment, options, gpu, journal, work, result};
    for (const SceneEntry& entry : experiment.scenes) run_scene(run, entry, result.scenes.emplace_back());
    work.finish();
    if (const std::size_t others = journal.files_before() - std::min(journal.files_before(), run.reused))
        warn(options, {fmt::format("{}: {} finished views there belong to other settings, scenes or seeds "
                                   "and are not used",
                                   options.journal.string(), others)});
    add_means(result);
    return result;
}

TruthCount render_truths(const Experiment& experiment, const RunOptions& options) {
    require_memory_for(experiment);
    require_judge(experiment.truth);
    parse_uses(experiment.uses);
    TruthCount count;
    Work work(experiment, options);
    for (const SceneEntry& entry : experiment.scenes) {
        Scene scene = load_scene(entry.file, entry.load);
        warn(options, scene.warnings);
        scene = reference_scene(scene, entry.frame, experiment.truth.true_environment);
        const RayCaster rays(scene);
        std::vector<std::string> warnings;
        for (const ViewTask& task : tasks_of(experiment, entry, rays, work)) {
            if (work.out_of_time()) {
                work.skip(task), ++count.missing;
                continue;
            }
            const Truth truth = judge_view(rays, experiment.truth, task, options.cache, warnings);
            ++(truth.cached ? count.cached : count.rendered);
            truth.cached ? work.skip(task) : work.done(task);
        }
        warn(options, warnings);
    }
    work.finish();
    return count;
}

} // namespace luxel
