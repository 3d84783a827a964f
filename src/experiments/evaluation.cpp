// SPDX-License-Identifier: MIT
#include "experiments/evaluation.h"

#include <algorithm>
#include <set>

#include "core/error.h"
#include "experiments/components.h"
#include "experiments/memory_budget.h"
#include "experiments/timing.h"
#include "scene/lights.h"
#include "techniques/frame/renderer.h"

namespace luxel {

namespace {

constexpr int warm_up_frames = 2; // pipelines compile at their first use

ReferenceRequest reference_request(const EvaluationSettings& settings, const Camera& camera) {
    // The usual components always come along, so that runs that ask for different sums share one rendering.
    std::set<std::string> components(settings.components.begin(), settings.components.end());
    if (!is_accessibility(settings.components)) components.insert({"direct", "diffuse1"});

    ReferenceRequest request;
    if (is_accessibility(settings.components)) {
        request.settings.ao_radius = settings.ao_radius;
        request.settings.ao_membership = settings.ao_membership;
    }
    request.components.assign(components.begin(), components.end());
    request.width = settings.width, request.height = settings.height;
    request.camera = camera;
    request.settings.spp = settings.spp;
    request.settings.seed = settings.seed;
    request.settings.pixel_center = true; // where the rasterizer samples
    request.quiet = settings.quiet;
    return request;
}

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

// The rows take turns, so that what slows the machine for a while slows them all.
std::vector<RowFrames> render_rows(Renderer& renderer, std::vector<TechniqueRow>& rows,
                                   const EvaluationSettings& settings, const Camera& camera) {
    const bool accessibility = is_accessibility(settings.components);
    std::vector<RowFrames> frames(rows.size());
    for (int i = -warm_up_frames; i < settings.timed_frames; ++i)
        for (std::size_t r = 0; r < rows.size(); ++r) {
            RenderRequest request;
            request.camera = camera;
            request.width = settings.width, request.height = settings.height;
            request.accessibility = accessibility;
            for (const auto& technique : rows[r].techniques) request.techniques.push_back(technique.get());
            frames[r].last = renderer.render(request);
            if (accessibility) complete_accessibility(rows[r], frames[r].last);
            if (i >= 0) frames[r].times.push_back(frames[r].last.passes);
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

ViewResult evaluate_view(Renderer& renderer, const RayCaster& rays, const Camera& camera,
                         const EvaluationSettings& settings, std::vector<TechniqueRow>& rows,
                         std::vector<std::string>& warnings, const PictureSink& sink) {
    // The frames first: a row that cannot be compared should say so before minutes of path tracing. Every row
    // sees the same surfaces, so that the baseline's mask is everyone's.
    std::vector<RowFrames> frames = render_rows(renderer, rows, settings, camera);
    const Truth truth = find_truth(rays, reference_request(settings, camera), settings.cache, warnings);
    ViewResult view;
    view.camera = camera;
    view.reference_spp = truth.spp;
    view.reference_seconds = truth.seconds;
    view.reference_cached = truth.cached;

    const Target target = make_target(truth, settings.components, frames[0].last.mask);
    view.exposure = target.exposure;
    view.noise = target.noise;
    std::vector<Candidate> candidates;
    for (RowFrames& f : frames) {
        Image& image = is_accessibility(settings.components) ? f.last.accessibility : f.last.radiance;
        candidates.push_back(make_candidate(target, std::move(image)));
        view.rows.push_back(row_result(f));
        view.rows.back().figures = measure(target, candidates[0], candidates.back());
        view.rows.back().claimed = is_claimed(view.rows.back().figures);
    }
    sink({view, target, candidates});
    return view;
}

RowResult mean_row(const EvaluationResult& result, std::size_t index) {
    RowResult mean;
    std::vector<Figures> figures;
    std::vector<FrameTime> times;
    for (const ViewResult& view : result.views) {
        const RowResult& row = view.rows[index];
        figures.push_back(row.figures);
        times.push_back({row.ms, row.passes});
        mean.memory_bytes += row.memory_bytes / result.views.size();
    }
    const FrameTime time = mean_time(times);
    mean.figures = mean_of(figures);
    mean.ms = time.ms;
    mean.passes = time.passes;
    return mean;
}

} // namespace

Scene reference_scene(const Scene& scene, const FrameOptions& frame, bool true_environment) {
    Scene lit = scene;
    if (frame.environment == EnvironmentMode::none) lit.environment = {};
    if (frame.environment == EnvironmentMode::lights && !true_environment && !lit.environment.empty())
        return with_environment_as_lights(std::move(lit), frame.environment_lights,
                                          std::uint32_t(frame.seed));
    return lit;
}

EvaluationResult evaluate(const Scene& scene, const EvaluationSettings& settings,
                          std::vector<TechniqueRow> rows, const PictureSink& sink) {
    LUXEL_ASSERT(!rows.empty() && rows[0].techniques.empty(), "rows={}", rows.size());
    // The device first: a machine without one should say so before minutes of path tracing.
    require_memory(settings.width, settings.height, settings.components.size() + 2);
    gpu::Gpu gpu({.device = settings.device});
    Renderer renderer(gpu, scene, settings.frame);
    const Scene truth_scene = reference_scene(scene, settings.frame, settings.true_environment);
    const RayCaster rays(truth_scene);
    const std::vector<Camera> cameras = choose_views(rays, settings.views);

    EvaluationResult result;
    result.settings = settings;
    result.device = gpu.device();
    for (const TechniqueRow& row : rows) result.rows.push_back({row.label, row.name, row.parameters});
    for (const Camera& camera : cameras)
        result.views.push_back(evaluate_view(renderer, rays, camera, settings, rows, result.warnings, sink));

    for (const ViewResult& view : result.views) result.mean_noise += view.noise / double(cameras.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
        result.mean.push_back(mean_row(result, i));
        result.mean[i].claimed = is_claimed(result.mean[i].figures);
    }
    return result;
}

} // namespace luxel
