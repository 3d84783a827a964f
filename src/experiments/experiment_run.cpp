// SPDX-License-Identifier: MIT
#include "experiments/experiment_run.h"

#include <algorithm>
#include <chrono>
#include <map>
#include <optional>

#include "core/error.h"
#include "core/progress.h"
#include "experiments/components.h"
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
        : progress_(experiment.name, options.quiet), quiet_(options.quiet), stop_(options.stop),
          seconds_(options.seconds) {
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
    // Within a view, of which `share` is done.
    void update(const ViewTask& task, const std::string& doing, double share) {
        progress_.update((done_ + share * pixels(task)) / std::max(done_ + left_, 1.0), doing);
    }
    void say(const std::string& line) { progress_.say(line); }
    bool quiet() const { return quiet_; }
    void finish() { progress_.finish(); }
    bool stopped() const { return stop_ && stop_(); }
    bool out_of_time() const {
        return stopped() ||
               (seconds_ > 0 && std::chrono::duration<double>(Clock::now() - start_).count() > seconds_);
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
    bool quiet_;
    std::function<bool()> stop_;
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
            tasks.push_back(
                {camera, group.width, group.height, experiment.timed_frames, entry.frame.supersample > 1});
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
            require_memory(group.width, group.height, experiment.truth.components.size() + 4);
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

ViewWatch watch_of(Run& run, const SceneEntry& entry, const ViewTask& task) {
    const std::string name = run.experiment.scenes.size() > 1
                                 ? fmt::format("{}, {}", entry.name, task.camera.name)
                                 : task.camera.name;
    ViewWatch watch;
    watch.progress = [&run, &task, name](const std::string& doing, double share) {
        run.work.update(task, fmt::format("{}: {}", name, doing), share);
    };
    if (!run.work.quiet())
        watch.say = [&run, name](const std::string& line) {
            run.work.say(fmt::format("{}: {}", name, line));
        };
    watch.stop = [&run] { return run.work.stopped(); };
    return watch;
}

// "isr: it needs a light; gtao, ssao: it needs ..."
std::string reasons(const std::vector<const TechniqueRow*>& rows) {
    std::vector<std::pair<std::string, std::string>> by_reason;
    for (const TechniqueRow* row : rows) {
        auto same = std::find_if(by_reason.begin(), by_reason.end(),
                                 [&](const auto& entry) { return entry.first == row->idle; });
        if (same == by_reason.end())
            by_reason.emplace_back(row->idle, row->label);
        else
            same->second += ", " + row->label;
    }
    std::string text;
    for (const auto& [reason, labels] : by_reason)
        text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", labels, reason);
    return text;
}

// One sentence for all rows that cannot act here, and one for each idle part of a row. Error Fault::usage
// where nothing is left to measure.
std::vector<std::string> idle_sentences(const Experiment& experiment, const SceneEntry& entry,
                                        const Scene& scene, const std::vector<TechniqueRow>& rows) {
    std::vector<const TechniqueRow*> named, of_all;
    std::vector<std::string> sentences;
    for (const TechniqueRow& row : rows) {
        if (!row.idle.empty()) (row.of_all ? of_all : named).push_back(&row);
        for (std::string& part : idle_parts(row, scene, entry.frame)) sentences.push_back(std::move(part));
    }
    const std::size_t asked = rows.size() - 1;
    if (asked > 0 && named.size() + of_all.size() == asked && experiment.scenes.size() == 1)
        fail(Fault::usage, "--use: nothing can act in {}: {}", entry.source,
             reasons(named.empty() ? of_all : named));
    const auto add = [&](const std::vector<const TechniqueRow*>& idle, const char* what) {
        if (!idle.empty())
            sentences.push_back(fmt::format("{}: {} of {} rows cannot act and {}: {}", entry.name,
                                            idle.size(), asked, what, reasons(idle)));
    };
    add(named, "have the figures of direct light");
    add(of_all, experiment.scenes.size() == 1 ? "are left out" : "are not measured there");
    return sentences;
}

std::vector<TechniqueRow> rows_for(const Experiment& experiment, const SceneEntry& entry,
                                   const Scene& scene) {
    std::vector<TechniqueRow> rows = parse_uses(experiment.uses);
    // An accessibility is measured by itself, whatever it would darken.
    if (!is_accessibility(experiment.truth.components)) mark_idle(rows, scene, entry.frame);
    return rows;
}

void run_scene(Run& run, const SceneEntry& entry, SceneResult& result) {
    const Scene scene = load_scene(entry.file, entry.load);
    result.warnings = entry.warnings;
    result.warnings.insert(result.warnings.end(), scene.warnings.begin(), scene.warnings.end());
    for (std::string& sentence :
         idle_sentences(run.experiment, entry, scene, rows_for(run.experiment, entry, scene)))
        result.warnings.push_back(std::move(sentence));
    warn(run.options, result.warnings);
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
        if (!renderer) renderer.emplace(run.gpu, scene, entry.frame);
        std::vector<TechniqueRow> rows = rows_for(run.experiment, entry, scene);
        const auto sink = [&](const ViewPictures& p) { return run.options.pictures(entry, p); };
        std::optional<ViewResult> view =
            evaluate_view({*renderer, rays, run.options.cache}, task, run.experiment.truth, rows, sink,
                          watch_of(run, entry, task));
        if (!view) {
            run.work.skip(task), ++run.result.missing;
            continue;
        }
        result.views.push_back(std::move(*view));
        // What was cut short is begun again, from the truth's checkpoint.
        if (!result.views.back().partial) run.journal.store(key, run.result.rows, result.views.back());
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
            if (std::all_of(views.begin(), views.end(),
                            [&](const ViewResult* v) { return !v->rows[row].unmeasured.empty(); }))
                continue;
            summary.push_back(summarize(views, row));
            summary.back().group = name;
            summary.back().label = result.rows[row].label;
        }
    return summary;
}

// Rows of "--use all" that could act nowhere are none.
void drop_idle(ExperimentResult& result) {
    std::vector<ViewResult*> views;
    for (SceneResult& scene : result.scenes)
        for (ViewResult& view : scene.views) views.push_back(&view);
    for (std::size_t row = result.rows.size(); row-- > 1;) {
        const auto idle = [&](const ViewResult* v) {
            return v->rows[row].unmeasured.starts_with("cannot act");
        };
        if (!result.rows[row].of_all || views.empty() || !std::all_of(views.begin(), views.end(), idle))
            continue;
        result.rows.erase(result.rows.begin() + std::ptrdiff_t(row));
        for (ViewResult* view : views) {
            view->rows.erase(view->rows.begin() + std::ptrdiff_t(row));
            if (view->pictures.is_object()) view->pictures["rows"].erase(row);
        }
    }
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
    for (TechniqueRow& row : parse_uses(experiment.uses)) {
        warn(options, row.warnings);
        result.rows.push_back(
            {std::move(row.label), std::move(row.name), std::move(row.parameters), row.of_all});
    }
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
    result.interrupted = work.stopped();
    drop_idle(result);
    add_means(result);
    return result;
}

TruthCount render_truths(const Experiment& experiment, const RunOptions& options) {
    require_memory_for(experiment);
    require_judge(experiment.truth);
    TruthCount count;
    Work work(experiment, options);
    for (const SceneEntry& entry : experiment.scenes) {
        Scene scene = load_scene(entry.file, entry.load);
        warn(options, scene.warnings);
        TruthSettings settings = experiment.truth;
        settings.also = also_measured(settings, rows_for(experiment, entry, scene));
        scene = reference_scene(scene, entry.frame, experiment.truth.true_environment);
        const RayCaster rays(scene);
        std::vector<std::string> warnings;
        for (const ViewTask& task : tasks_of(experiment, entry, rays, work)) {
            if (work.out_of_time()) {
                work.skip(task), ++count.missing;
                continue;
            }
            const Truth truth = judge_view(rays, settings, task, options.cache, warnings, [&](int spp) {
                work.update(task, fmt::format("{}: {} of {} samples", task.camera.name, spp, settings.spp),
                            double(spp) / double(settings.spp));
                return !work.stopped();
            });
            if (!truth.complete) {
                work.skip(task), ++count.missing;
                continue;
            }
            ++(truth.cached ? count.cached : count.rendered);
            truth.cached ? work.skip(task) : work.done(task);
        }
        warn(options, warnings);
    }
    work.finish();
    return count;
}

} // namespace luxel
