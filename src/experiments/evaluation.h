// SPDX-License-Identifier: MIT
// One view: the truth and every row of techniques, with error, time and memory.
#pragma once
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "experiments/figures.h"
#include "experiments/view_frames.h"

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
    Judge judge = Judge::reference;  // povray: of "direct" and "direct+diffuse1" alone; spp does not matter
    std::vector<std::string> also{}; // components that rows are measured against besides
};

// A row against direct light and what its techniques compute, as if that had been asked for.
struct OwnResult {
    std::string component; // "direct+caustics"
    Figures figures;
    bool claimed = false;
};

struct RowResult {
    Figures figures;
    bool claimed = false;              // the gain is larger than the reference's noise
    double ms = 0;                     // GPU time of a frame: cost.base and cost.technique
    std::vector<gpu::PassTime> passes; // medians
    std::uint64_t memory_bytes = 0;
    RowCost cost;
    std::optional<OwnResult> own; // none for the baseline, occlusion as truth, and POV-Ray as judge
    std::string unmeasured; // why there are no figures: they are the baseline's then; "" where there are
    int views = 1;          // of a mean: those in which the row was measured
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
    bool partial = false;              // it was stopped; what is there is of fewer samples or fewer rows
};

struct RowName {
    std::string label, name;
    std::vector<ParameterInfo> parameters;
    bool of_all = false; // see TechniqueRow
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

// What may be told how far a view is, and asked whether to go on. Each may be empty.
struct ViewWatch {
    std::function<void(const std::string& doing, double share)> progress; // share of the view, in [0, 1]
    std::function<void(const std::string& line)> say;                     // a figure that is there
    std::function<bool()> stop;
};

// The components that the rows are measured against beside the truth's own. Rows that are idle need none.
std::vector<std::string> also_measured(const TruthSettings& truth, const std::vector<TechniqueRow>& rows);

// `rows` begins with the baseline and has seen no frame yet: what is measured does not depend on other views.
// Each row's techniques are gone afterwards. Nothing where it was stopped before there was anything to
// compare.
std::optional<ViewResult> evaluate_view(const SceneOnStage& stage, const ViewTask& task,
                                        const TruthSettings& truth, std::vector<TechniqueRow>& rows,
                                        const PictureSink& sink, const ViewWatch& watch = {});

} // namespace luxel
