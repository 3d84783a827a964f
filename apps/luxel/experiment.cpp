// SPDX-License-Identifier: MIT
// luxel experiment: many scenes, views and techniques from a file; goes on where a killed run stopped.
#include <cstdio>

#include "core/error.h"
#include "core/interrupt.h"
#include "experiments/experiment_file.h"
#include "experiments/experiment_run.h"
#include "experiments/output_folder.h"
#include "experiments/result_files.h"
#include "experiments/results_json.h"
#include "experiments/table.h"
#include "options.h"

namespace luxel::app {

namespace {

struct Options {
    std::string file, output, device;
    CacheChoice cache;
    double minutes = 0;
    bool only_truth = false, verbose = false;
};

Experiment load(const Options& o, const Global& global) {
    if (!global.environment.empty())
        fail(Fault::usage, "--environment: here it belongs into the file, to each scene");
    Experiment experiment = load_experiment_file(o.file, global.data);
    for (SceneEntry& scene : experiment.scenes) scene.load.strict = global.strict;
    return experiment;
}

void print_truths(const TruthCount& count, const Global& global) {
    if (global.json)
        return print_json(
            {{"rendered", count.rendered}, {"cached", count.cached}, {"missing", count.missing}});
    fmt::print("{} truths rendered, {} were there, {} are left\n", count.rendered, count.cached,
               count.missing);
}

void run(const Options& o, const Global& global) {
    const Experiment experiment = load(o, global);
    const InterruptScope interrupt;
    RunOptions options = {.device = o.device,
                          .cache = o.cache.path(),
                          .quiet = global.quiet,
                          .seconds = 60 * o.minutes,
                          .stop = [&] { return interrupt.signal() != 0; },
                          .warn = print_warnings};
    if (o.only_truth) {
        if (options.cache.empty()) fail(Fault::usage, "--only-truth: without a cache it would leave nothing");
        print_truths(render_truths(experiment, options), global);
        if (interrupt.signal() != 0) throw Interrupted{interrupt.signal()};
        return;
    }

    if (o.output.empty()) fail(Fault::usage, "command line: -o is required, unless --only-truth is given");
    const PictureFiles pictures(o.output, experiment);
    OutputFolder output(o.output);
    options.journal = output.path() / journal_folder;
    options.pictures = [&](const SceneEntry& scene, const ViewPictures& view) {
        return pictures.add(scene, view);
    };
    const ExperimentResult result = run_experiment(experiment, options);
    finish_run(output, result, o.verbose, global);
    if (result.interrupted) throw Interrupted{interrupt.signal()};
}

} // namespace

void add_experiment(CLI::App& app, const Global& global) {
    auto o = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand(
        "experiment", "Measure techniques over many scenes and views, as a TOML file says");
    command->add_option("file", o->file, "Experiment file, .toml; see docs/experiments.md")->required();
    command->add_option("-o,--output", o->output,
                        "Folder for report.html, results.json, results.csv and what is finished");
    command->add_option("--device", o->device, "GPU by number or part of its name; see luxel devices");
    add_cache_options(*command, o->cache);
    command->add_flag("--only-truth", o->only_truth,
                      "Render the truths into the cache and stop; needs no GPU and no -o");
    command->add_option("--minutes", o->minutes, "Begin no view after this time and report what is finished")
        ->check(CLI::PositiveNumber);
    command->add_flag("--verbose", o->verbose, "Print every view and the time by pass");
    command->footer(
        "Every view is kept under DIR/views as soon as all its rows are measured. Stopped at any moment "
        "(Ctrl-C,\n"
        "kill -9, a power cut), the same command goes on with the views that are left. What the file, a "
        "scene or\n"
        "the program's version changes is measured again, everything else is not.\n"
        "Examples:\n"
        "  luxel experiment experiments/quick.toml -o out\n"
        "  luxel experiment experiments/rohleder-2010.toml --data ../shared/data --only-truth\n"
        "  luxel experiment experiments/rohleder-2010.toml --data ../shared/data --minutes 30 -o out");
    command->callback([o, &global] { run(*o, global); });
}

} // namespace luxel::app
