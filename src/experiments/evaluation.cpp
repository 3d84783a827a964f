// SPDX-License-Identifier: MIT
#include "experiments/evaluation.h"

#include <set>

#include <fmt/ranges.h>

#include "core/error.h"
#include "core/metrics.h"
#include "experiments/components.h"
#include "experiments/judge.h"
#include "experiments/noise_free.h"
#include "experiments/picture_row.h"
#include "scene/height_field.h"
#include "scene/lights.h"

namespace luxel {

namespace {

std::set<std::string> set_of(const std::vector<std::string>& names) { return {names.begin(), names.end()}; }

} // namespace

Scene reference_scene(const Scene& scene, const FrameOptions& frame, bool true_environment) {
    Scene lit = with_height_fields(scene);
    if (frame.environment == EnvironmentMode::none) lit.environment = {};
    if (frame.environment == EnvironmentMode::lights && !true_environment && !lit.environment.empty())
        return with_environment_as_lights(std::move(lit), frame.environment_lights,
                                          std::uint32_t(frame.seed));
    return lit;
}

ReferenceRequest reference_request(const TruthSettings& truth, const ViewTask& task) {
    // The usual components always come along, so that runs that ask for different sums share one rendering.
    std::set<std::string> components(truth.components.begin(), truth.components.end());
    ReferenceRequest request;
    if (is_accessibility(truth.components)) {
        request.settings.ao_radius = truth.ao_radius;
        request.settings.ao_membership = truth.ao_membership;
    } else {
        components.insert({"direct", "diffuse1"});
    }
    components.insert(truth.also.begin(), truth.also.end());
    request.components.assign(components.begin(), components.end());
    request.width = task.width, request.height = task.height;
    request.camera = task.camera;
    request.settings.spp = truth.spp;
    request.settings.seed = truth.seed;
    request.settings.pixel_center = !task.pixel_area; // where the rasterizer samples
    return request;
}

std::vector<std::string> also_measured(const TruthSettings& truth, const std::vector<TechniqueRow>& rows) {
    std::set<std::string> components;
    if (is_accessibility(truth.components) || truth.judge != Judge::reference) return {};
    for (const TechniqueRow& row : rows)
        if (!row.techniques.empty() && row.idle.empty()) components.merge(set_of(own_components(row)));
    for (const std::string& asked : truth.components) components.erase(asked);
    return {components.begin(), components.end()};
}

namespace {

constexpr int early_samples = 8;      // of a truth that gives first figures
constexpr int least_samples = 4;      // of a truth that was cut off: less says nothing of its noise
constexpr double share_of_rows = 0.4; // of a view's time, by experience; the rest is the truth's

struct Stopped {};

// The rows of a view on their way: frames first, figures when a truth is there.
class ViewRun {
public:
    ViewRun(const SceneOnStage& stage, const ViewTask& task, TruthSettings truth,
            std::vector<TechniqueRow>& rows, const ViewWatch& watch)
        : stage_(stage), task_(task), truth_(std::move(truth)), rows_(rows), watch_(watch),
          accessibility_(is_accessibility(truth_.components)), frames_(rows.size()) {
        truth_.also = also_measured(truth_, rows_);
        for (const TechniqueRow& row : rows_) own_.push_back(own_of(row));
    }

    // False where it was stopped.
    bool draw(std::vector<std::string>& warnings);
    Truth judge(std::vector<std::string>& warnings);
    ViewResult result(const Truth& truth, const PictureSink& sink);
    bool has_baseline() const { return frames_[0].has_value(); }

private:
    void step() const {
        if (watch_.stop && watch_.stop()) throw Stopped();
    }
    void progress(const std::string& doing, double share) const {
        if (watch_.progress) watch_.progress(doing, share);
    }
    // The components that the row is measured against besides; empty where these are none.
    std::vector<std::string> own_of(const TechniqueRow& row) const {
        if (row.techniques.empty() || !row.idle.empty() || accessibility_ || truth_.judge != Judge::reference)
            return {};
        return own_components(row);
    }
    void draw_rows(std::vector<std::string>& warnings);
    RowFrames picture_frames(const TechniqueRow& row, std::vector<std::string>& warnings) const;
    void say_early(const Target& early, int spp, std::size_t row) const;
    void measure_own(const Truth& truth, ViewResult& view) const;

    const SceneOnStage& stage_;
    const ViewTask& task_;
    TruthSettings truth_;
    std::vector<TechniqueRow>& rows_;
    const ViewWatch& watch_;
    bool accessibility_;
    std::vector<std::vector<std::string>> own_;    // by row
    std::vector<std::optional<RowFrames>> frames_; // by row; none: not drawn, or idle
    Image mask_;
};

void ViewRun::say_early(const Target& early, int spp, std::size_t row) const {
    const Candidate baseline = make_candidate(early, frames_[0]->image),
                    candidate = make_candidate(early, frames_[row]->image);
    const NoiseFree found = noise_free_figures(early, baseline, candidate);
    watch_.say(fmt::format(
        "{}: gain {:.1f} +- {:.1f} % after {} of {} samples; {:.1f} ms on a frame of {:.1f} ms",
        rows_[row].label, gain(found.figures.baseline_delta, found.figures.delta), found.gain_error, spp,
        truth_.spp, frames_[row]->cost.technique.ms, frames_[0]->cost.base.ms));
}

// What was read and not rendered has neither time nor memory.
RowFrames ViewRun::picture_frames(const TechniqueRow& row, std::vector<std::string>& warnings) const {
    if (accessibility_)
        fail(Fault::usage, "--image {}: it is a picture of light, and --component ao measures accessibility",
             row.label);
    return {.image = read_picture(row, task_.camera, task_.width, task_.height, warnings)};
}

void ViewRun::draw_rows(std::vector<std::string>& warnings) {
    progress("frame", 0.0);
    ViewFrames view(stage_.renderer, task_, accessibility_, [this] { step(); });
    frames_[0] = view.baseline();
    mask_ = view.mask();

    // A few samples of the truth first, so that each row has a figure as soon as it is drawn.
    std::optional<Target> early;
    int spp = 0;
    if (watch_.say) {
        progress("first samples of the truth", 0.0);
        if (const auto first =
                early_truth(stage_.rays, truth_, task_, early_samples, stage_.cache, warnings)) {
            early = make_target(*first, judged_layers(truth_), mask_);
            spp = first->spp;
        }
    }
    for (std::size_t r = 1; r < rows_.size(); ++r) {
        TechniqueRow& row = rows_[r];
        progress(row.label, share_of_rows * double(r - 1) / double(rows_.size() - 1));
        if (!row.idle.empty()) continue;
        frames_[r] = is_picture(row) ? picture_frames(row, warnings) : view.row(row);
        for (const std::string& warning : frames_[r]->warnings)
            warnings.push_back(fmt::format("{}: {}", row.label, warning));
        row.techniques.clear(); // their images are no part of what the next row needs
        if (early && !is_picture(row)) say_early(*early, spp, r);
    }
}

bool ViewRun::draw(std::vector<std::string>& warnings) {
    try {
        draw_rows(warnings);
    } catch (const Stopped&) {
        return false;
    }
    return true;
}

Truth ViewRun::judge(std::vector<std::string>& warnings) {
    return judge_view(stage_.rays, truth_, task_, stage_.cache, warnings, [this](int spp) {
        const double share = double(spp) / double(truth_.spp);
        progress(fmt::format("truth, {} of {} samples", spp, truth_.spp),
                 share_of_rows + (1.0 - share_of_rows) * share);
        return !(watch_.stop && watch_.stop());
    });
}

// One target at a time: each holds its truth from fewer samples ten times.
void ViewRun::measure_own(const Truth& truth, ViewResult& view) const {
    for (const std::vector<std::string>& components : std::set(own_.begin(), own_.end())) {
        if (components.empty()) continue;
        const bool asked = set_of(components) == set_of(truth_.components);
        std::optional<Target> target;
        std::optional<Candidate> baseline;
        for (std::size_t r = 0; r < rows_.size(); ++r) {
            RowResult& row = view.rows[r];
            if (own_[r] != components || !row.unmeasured.empty()) continue;
            row.own = {.component = fmt::format("{}", fmt::join(components, "+"))};
            if (asked) {
                row.own->figures = row.figures;
            } else {
                if (!target) {
                    target = make_target(truth, components, mask_);
                    baseline = make_candidate(*target, frames_[0]->image);
                }
                row.own->figures = measure(*target, *baseline, make_candidate(*target, frames_[r]->image));
            }
            row.own->claimed = is_claimed(row.own->figures);
        }
    }
}

ViewResult ViewRun::result(const Truth& truth, const PictureSink& sink) {
    ViewResult view;
    view.camera = task_.camera;
    view.width = task_.width, view.height = task_.height;
    view.reference_spp = truth.spp;
    view.reference_seconds = truth.seconds;
    view.reference_cached = truth.cached;
    const Target target = make_target(truth, judged_layers(truth_), mask_);
    view.exposure = target.exposure;
    view.noise = target.noise;
    std::vector<Candidate> candidates;
    for (std::size_t r = 0; r < rows_.size(); ++r) {
        // What cannot act is the baseline, and costs what nobody measured.
        const bool drawn = frames_[r].has_value();
        const RowFrames& frames = drawn ? *frames_[r] : *frames_[0];
        candidates.push_back(make_candidate(target, frames.image));
        RowResult row{.ms = frames.cost.base.ms + frames.cost.technique.ms,
                      .passes = frames.passes,
                      .memory_bytes = frames.memory_bytes,
                      .cost = frames.cost};
        if (!drawn) row.unmeasured = rows_[r].idle.empty() ? "interrupted" : "cannot act: " + rows_[r].idle;
        row.views = drawn ? 1 : 0;
        row.figures = measure(target, candidates[0], candidates.back());
        row.claimed = drawn && is_claimed(row.figures);
        view.rows.push_back(std::move(row));
    }
    measure_own(truth, view);
    view.pictures = sink({view, target, candidates});
    return view;
}

} // namespace

std::optional<ViewResult> evaluate_view(const SceneOnStage& stage, const ViewTask& task,
                                        const TruthSettings& truth, std::vector<TechniqueRow>& rows,
                                        const PictureSink& sink, const ViewWatch& watch) {
    LUXEL_ASSERT(!rows.empty() && rows[0].techniques.empty(), "rows={}", rows.size());
    ViewRun run(stage, task, truth, rows, watch);
    std::vector<std::string> warnings;
    const bool drawn = run.draw(warnings);
    if (!run.has_baseline()) return std::nullopt;
    const Truth found = run.judge(warnings);
    if (!found.complete && found.spp < least_samples) return std::nullopt;
    ViewResult view = run.result(found, sink);
    view.warnings = std::move(warnings);
    view.partial = !drawn || !found.complete;
    return view;
}

} // namespace luxel
