// SPDX-License-Identifier: MIT
// Carries an experiment out, scene by scene and view by view, from where it was left.
#pragma once
#include "experiments/experiment.h"

namespace luxel {

struct RunOptions {
    std::string device;
    gpu::Gpu* gpu = nullptr;       // of several runs, which share its pipelines; null: one of the run's own
    std::filesystem::path cache;   // of truths; empty = none
    std::filesystem::path journal; // folder of finished views; empty = none
    bool quiet = false;
    double seconds = 0;         // begin no view after this time; 0 = no limit
    std::function<bool()> stop; // true: end in good order with what there is; may be empty
    std::function<void(const std::vector<std::string>&)> warn; // sentences, as they come up
    // The pictures of a view, for ViewResult::pictures.
    std::function<nlohmann::ordered_json(const SceneEntry&, const ViewPictures&)> pictures;
};

// Error Fault::usage: unknown techniques; Fault::unsupported without a usable device; those of loading.
ExperimentResult run_experiment(const Experiment& experiment, const RunOptions& options);

// Renders what truths the cache lacks, without any GPU.
struct TruthCount {
    int rendered = 0, cached = 0, missing = 0; // missing: there was no time for them
};
TruthCount render_truths(const Experiment& experiment, const RunOptions& options);

} // namespace luxel
