// SPDX-License-Identifier: MIT
// The experiment: for every view the truth and every row of techniques, with error, time and memory.
#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "experiments/figures.h"
#include "experiments/technique_rows.h"
#include "experiments/view_choice.h"
#include "techniques/frame/frame.h"

namespace luxel {

struct EvaluationSettings {
    std::string scene;                                            // as typed, for the record
    std::vector<std::string> components = {"direct", "diffuse1"}; // whose sum is the truth
    ViewChoice views;
    int width = 640, height = 480;
    float ao_radius = 1.0f; // meters, for the component ao
    Membership ao_membership = Membership::step;
    int spp = 64;
    int seed = 1;
    FrameOptions frame;
    bool true_environment = false; // the reference keeps the environment where the frame samples it as lights
    std::string device;
    std::filesystem::path cache; // empty = none
    int timed_frames = 5;
    bool quiet = false;
};

struct RowResult {
    Figures figures;
    bool claimed = false;              // the gain is larger than the reference's noise
    double ms = 0;                     // GPU time of a frame: median of the timed frames
    std::vector<gpu::PassTime> passes; // medians
    std::uint64_t memory_bytes = 0;
};

struct ViewResult {
    Camera camera;
    float exposure = 1;
    double noise = 0;
    int reference_spp = 0;
    double reference_seconds = 0;
    bool reference_cached = false;
    std::vector<RowResult> rows; // as EvaluationResult::rows
};

struct RowName {
    std::string label, name;
    std::vector<ParameterInfo> parameters;
};

struct EvaluationResult {
    EvaluationSettings settings;
    gpu::DeviceInfo device;
    std::vector<RowName> rows;
    std::vector<ViewResult> views;
    std::vector<RowResult> mean; // over views, per row
    double mean_noise = 0;
    std::vector<std::string> warnings;
};

// The pictures of one view, handed on as soon as they are there and not kept.
struct ViewPictures {
    const ViewResult& result;
    const Target& target;
    const std::vector<Candidate>& rows; // the baseline first
};
using PictureSink = std::function<void(const ViewPictures&)>;

// The scene as the reference is to light it, by the frame's treatment of the environment.
Scene reference_scene(const Scene& scene, const FrameOptions& frame, bool true_environment);

// `rows` begins with the baseline. Error Fault::unsupported without a usable device.
EvaluationResult evaluate(const Scene& scene, const EvaluationSettings& settings,
                          std::vector<TechniqueRow> rows, const PictureSink& sink);

} // namespace luxel
