// SPDX-License-Identifier: MIT
#include "experiments/evaluation.h"

#include <set>

#include "core/error.h"
#include "experiments/components.h"
#include "experiments/judge.h"
#include "experiments/picture_row.h"
#include "experiments/timing.h"
#include "scene/height_field.h"
#include "scene/lights.h"

namespace luxel {

namespace {

constexpr int warm_up_frames = 2; // pipelines compile at their first use

struct RowFrames {
    RenderResult last;
    std::vector<std::vector<gpu::PassTime>> times;
};

// The baseline is all open; every other row has to say how open.
void complete_accessibility(const TechniqueRow& row, RenderResult& frame) {
    if (row.techniques.empty())
        frame.accessibility = Image(frame.mask.width, frame.mask.height, 1, 1.0f);
    else if (frame.accessibility.empty())
        fail(Fault::usage,
             "--use {}: this row delivers no accessibility, which is what --component ao measures",
             row.label);
}

RenderResult render_row(Renderer& renderer, const ViewTask& task, TechniqueRow& row, bool accessibility) {
    RenderRequest request;
    request.camera = task.camera;
    request.width = task.width, request.height = task.height;
    request.accessibility = accessibility;
    for (const auto& technique : row.techniques) request.techniques.push_back(technique.get());
    RenderResult frame = renderer.render(request);
    if (accessibility) complete_accessibility(row, frame);
    return frame;
}

// What was read and not rendered has neither time nor memory.
RowFrames picture_frames(const TechniqueRow& row, const ViewTask& task, bool accessibility,
                         std::vector<std::string>& warnings) {
    if (accessibility)
        fail(Fault::usage, "--image {}: it is a picture of light, and --component ao measures accessibility",
             row.label);
    RowFrames frames;
    frames.last.radiance = read_picture(row, task.camera, task.width, task.height, warnings);
    frames.times.emplace_back();
    return frames;
}

// The rows take turns, so that what slows the machine for a while slows them all.
std::vector<RowFrames> render_rows(Renderer& renderer, const ViewTask& task, std::vector<TechniqueRow>& rows,
                                   bool accessibility, std::vector<std::string>& warnings) {
    std::vector<RowFrames> frames(rows.size());
    for (std::size_t r = 0; r < rows.size(); ++r)
        if (is_picture(rows[r])) frames[r] = picture_frames(rows[r], task, accessibility, warnings);
    for (int i = 0; i < task.timed_frames; ++i)
        for (std::size_t r = 0; r < rows.size(); ++r) {
            if (is_picture(rows[r])) continue;
            frames[r].last = render_row(renderer, task, rows[r], accessibility);
            frames[r].times.push_back(frames[r].last.passes);
        }
    return frames;
}

RowResult row_result(const RowFrames& frames) {
    const FrameTime time = median_time(frames.times);
    RowResult row;
    row.ms = time.ms;
    row.passes = time.passes;
    row.memory_bytes = frames.last.memory_bytes;
    return row;
}

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
    request.components.assign(components.begin(), components.end());
    request.width = task.width, request.height = task.height;
    request.camera = task.camera;
    request.settings.spp = truth.spp;
    request.settings.seed = truth.seed;
    request.settings.pixel_center = true; // where the rasterizer samples
    return request;
}

void warm_up(Renderer& renderer, const ViewTask& task, std::vector<TechniqueRow>& rows) {
    for (int i = 0; i < warm_up_frames; ++i)
        for (TechniqueRow& row : rows)
            if (!is_picture(row)) render_row(renderer, task, row, false);
}

ViewResult evaluate_view(const SceneOnStage& stage, const ViewTask& task, const TruthSettings& truth,
                         std::vector<TechniqueRow>& rows, const PictureSink& sink) {
    LUXEL_ASSERT(!rows.empty() && rows[0].techniques.empty(), "rows={}", rows.size());
    // The frames first: a row that cannot be compared should say so before minutes of path tracing. Every row
    // sees the same surfaces, so that the baseline's mask is everyone's.
    const bool accessibility = is_accessibility(truth.components);
    ViewResult view;
    std::vector<RowFrames> frames = render_rows(stage.renderer, task, rows, accessibility, view.warnings);
    view.camera = task.camera;
    view.width = task.width, view.height = task.height;
    for (std::size_t r = 0; r < rows.size(); ++r)
        for (const std::string& warning : frames[r].last.warnings)
            view.warnings.push_back(fmt::format("{}: {}", rows[r].label, warning));
    const Truth found = judge_view(stage.rays, truth, task, stage.cache, view.warnings);
    view.reference_spp = found.spp;
    view.reference_seconds = found.seconds;
    view.reference_cached = found.cached;

    const Target target = make_target(found, judged_layers(truth), frames[0].last.mask);
    view.exposure = target.exposure;
    view.noise = target.noise;
    std::vector<Candidate> candidates;
    for (RowFrames& f : frames) {
        Image& image = accessibility ? f.last.accessibility : f.last.radiance;
        candidates.push_back(make_candidate(target, std::move(image)));
        view.rows.push_back(row_result(f));
        view.rows.back().figures = measure(target, candidates[0], candidates.back());
        view.rows.back().claimed = is_claimed(view.rows.back().figures);
    }
    view.pictures = sink({view, target, candidates});
    return view;
}

} // namespace luxel
