// SPDX-License-Identifier: MIT
// An experiment: scenes x views x rows of techniques against one kind of truth, and what came out of it.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "experiments/evaluation.h"
#include "experiments/statistics.h"
#include "experiments/view_choice.h"
#include "scene/load.h"

namespace luxel {

// Views of one size.
struct ViewGroup {
    ViewChoice choice;
    int width = 640, height = 480;
};

struct SceneEntry {
    std::string name;   // unique
    std::string source; // as typed, for the record
    std::string file;   // what load_scene takes
    std::string group;  // of the statistics
    LoadOptions load;
    FrameOptions frame;
    std::vector<ViewGroup> views;
    std::vector<std::string> warnings{}; // of its frame options
};

// none; small ones in the page; those, and every image in full on disk
enum class PictureMode { none, page, files };

struct Experiment {
    std::string name;
    std::vector<SceneEntry> scenes;
    std::vector<std::string> uses; // a row each, as after --use; the baseline is added
    TruthSettings truth;
    int timed_frames = 5;
    PictureMode pictures = PictureMode::page;
    int picture_width = 256; // pixels at most, in the page
};

struct SceneResult {
    std::vector<ViewResult> views; // those that are finished
    std::vector<RowResult> mean;   // over views, per row; empty without views
    double mean_noise = 0;
    std::vector<std::string> warnings;
};

struct ExperimentResult {
    Experiment experiment;
    gpu::DeviceInfo device;
    std::vector<RowName> rows;       // the baseline first
    std::vector<SceneResult> scenes; // as Experiment::scenes
    std::vector<RowResult> mean;     // over all views
    double mean_noise = 0;
    std::vector<Summary> summary;
    int missing = 0;          // views that there was no time for
    bool interrupted = false; // the run was stopped: views are missing, or the last one is partial
};

} // namespace luxel
