// SPDX-License-Identifier: MIT
// One view: the truth and every row of techniques, with error, time and memory.
#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "experiments/figures.h"
#include "experiments/technique_rows.h"
#include "techniques/frame/renderer.h"

namespace luxel {

enum class Judge { reference, povray };

// What the truth of a view is.
struct TruthSettings {
    std::vector<std::string> components = {"direct", "diffuse1"}; // their sum, or "ao" alone
    float ao_radius = 1.0f;                                       // meters
    Membership ao_membership = Membership::step;
    int spp = 64;
    int seed = 1;
    bool true_environment = false; // the reference keeps the environment where the frame samples it as lights
    Judge judge = Judge::reference; // povray: of "direct" and "direct+diffuse1" alone; spp does not matter
};

// One view to evaluate.
struct ViewTask {
    Camera camera;
    int width = 640, height = 480;
    int timed_frames = 5;
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
    int width = 0, height = 0;
    float exposure = 1;
    double noise = 0;
    int reference_spp = 0;
    double reference_seconds = 0;
    bool reference_cached = false;
    std::vector<RowResult> rows;       // the baseline first
    nlohmann::ordered_json pictures;   // for the page, see result_files.h; null = none
    std::vector<std::string> warnings; // of its truth and its rows
};

struct RowName {
    std::string label, name;
    std::vector<ParameterInfo> parameters;
};

// The pictures of one view, handed on as soon as they are there and not kept.
struct ViewPictures {
    const ViewResult& result;
    const Target& target;
    const std::vector<Candidate>& rows; // the baseline first
};
using PictureSink = std::function<nlohmann::ordered_json(const ViewPictures&)>; // ViewResult::pictures

// The scene as the reference is to light it, by the frame's treatment of the environment; height maps are
// geometry in it.
Scene reference_scene(const Scene& scene, const FrameOptions& frame, bool true_environment);

ReferenceRequest reference_request(const TruthSettings& truth, const ViewTask& task);

// A scene on the GPU, and as rays for its truth.
struct SceneOnStage {
    Renderer& renderer;
    const RayCaster& rays;       // of reference_scene()
    std::filesystem::path cache; // of truths; empty = none
};

// Pipelines compile at their first use; what the rows remember of these frames is to be thrown away with
// them.
void warm_up(Renderer& renderer, const ViewTask& task, std::vector<TechniqueRow>& rows);

// `rows` begins with the baseline and has seen no frame yet: what is measured does not depend on other views.
ViewResult evaluate_view(const SceneOnStage& stage, const ViewTask& task, const TruthSettings& truth,
                         std::vector<TechniqueRow>& rows, const PictureSink& sink);

} // namespace luxel
