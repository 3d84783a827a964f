// SPDX-License-Identifier: MIT
#include "experiments/view_frames.h"

#include <algorithm>
#include <chrono>

#include "core/error.h"
#include "experiments/timing.h"

namespace luxel {

namespace {

using Passes = std::vector<gpu::PassTime>;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

double sum_of(const Passes& passes) {
    double sum = 0;
    for (const gpu::PassTime& pass : passes) sum += pass.ms;
    return sum;
}

std::vector<Technique*> pointers(const TechniqueRow& row) {
    std::vector<Technique*> techniques;
    for (const auto& technique : row.techniques) techniques.push_back(technique.get());
    return techniques;
}

} // namespace

RenderRequest ViewFrames::request() const {
    RenderRequest request;
    request.camera = task_.camera;
    request.width = task_.width, request.height = task_.height;
    request.accessibility = accessibility_;
    return request;
}

std::vector<Passes> ViewFrames::base_frames(const std::vector<Technique*>& techniques) {
    RenderRequest r = request();
    r.techniques = techniques;
    std::vector<Passes> frames;
    for (int i = 0; i <= task_.timed_frames; ++i) {
        step_();
        base_ = renderer_.base(r);
        if (i > 0) frames.push_back(base_.passes);
    }
    base_is_plain_ = techniques.empty();
    return frames;
}

// What composition costs every frame belongs to the base.
std::vector<double> ViewFrames::without_base(const std::vector<Passes>& frames) const {
    std::vector<double> sums;
    for (const Passes& frame : frames) {
        double sum = 0;
        for (const gpu::PassTime& pass : frame)
            if (std::find(composed_.begin(), composed_.end(), pass.name) == composed_.end()) sum += pass.ms;
        sums.push_back(sum);
    }
    return sums;
}

ViewFrames::ViewFrames(Renderer& renderer, const ViewTask& task, bool accessibility,
                       std::function<void()> step)
    : renderer_(renderer), task_(task), accessibility_(accessibility), step_(std::move(step)) {
    const std::vector<Passes> drawn = base_frames({});
    RenderRequest r = request();
    r.base = &base_;
    std::vector<Passes> composed;
    RenderResult last;
    for (std::size_t i = 0; i <= drawn.size(); ++i) {
        r.read = i == drawn.size();
        last = renderer_.render(r);
        if (i > 0) composed.push_back(last.passes);
    }
    std::vector<double> sums;
    for (std::size_t i = 0; i < drawn.size(); ++i) sums.push_back(sum_of(drawn[i]) + sum_of(composed[i]));
    for (const gpu::PassTime& pass : last.passes) composed_.push_back(pass.name);

    base_passes_ = median_time(drawn).passes;
    baseline_.cost.base = spread_of(std::move(sums));
    baseline_.passes = base_passes_;
    const Passes end = median_time(composed).passes;
    baseline_.passes.insert(baseline_.passes.end(), end.begin(), end.end());
    baseline_.memory_bytes = std::max(base_.memory_bytes, last.memory_bytes);
    mask_ = std::move(last.mask);
    // The baseline is open everywhere.
    baseline_.image = accessibility ? Image(mask_.width, mask_.height, 1, 1.0f) : std::move(last.radiance);
}

RowFrames ViewFrames::row(const TechniqueRow& row) {
    RenderRequest r = request();
    r.techniques = pointers(row);
    const bool displaced = std::any_of(row.techniques.begin(), row.techniques.end(),
                                       [](const auto& t) { return t->slot() == Slot::surface; });

    // A row with a search of height maps has a base frame of its own; what that costs more is the search's.
    std::vector<double> extra(std::size_t(task_.timed_frames), 0.0);
    Passes base_passes = base_passes_;
    if (displaced) {
        const std::vector<Passes> drawn = base_frames(r.techniques);
        base_passes = median_time(drawn).passes;
        for (std::size_t i = 0; i < drawn.size(); ++i) extra[i] = sum_of(drawn[i]) - sum_of(base_passes_);
    } else if (!base_is_plain_) {
        step_();
        base_ = renderer_.base(request());
        base_is_plain_ = true;
    }

    // The first frame prepares the techniques and fills what they keep.
    r.base = &base_;
    std::vector<Passes> frames;
    std::vector<double> walls;
    RenderResult last;
    for (int i = 0; i <= task_.timed_frames; ++i) {
        step_();
        r.read = i == task_.timed_frames;
        const Clock::time_point start = Clock::now();
        last = renderer_.render(r);
        if (!r.read || walls.empty()) walls.push_back(seconds_since(start));
        if (i > 0) frames.push_back(last.passes);
    }
    if (accessibility_ && last.accessibility.empty())
        fail(Fault::usage,
             "--use {}: this row delivers no accessibility, which is what --component ao measures",
             row.label);

    RowFrames out;
    std::vector<double> own = without_base(frames);
    for (std::size_t i = 0; i < own.size(); ++i) own[i] = std::max(own[i] + extra[i], 0.0);
    out.cost.base = baseline_.cost.base;
    out.cost.technique = spread_of(std::move(own));
    const double first = walls.front();
    if (walls.size() > 1)
        out.cost.preparation = std::max(first - median({walls.begin() + 1, walls.end()}), 0.0);
    out.passes = std::move(base_passes);
    const Passes added = median_time(frames).passes;
    out.passes.insert(out.passes.end(), added.begin(), added.end());
    out.memory_bytes = std::max(last.memory_bytes, displaced ? base_.memory_bytes : 0);
    out.warnings = std::move(last.warnings);
    out.image = std::move(accessibility_ ? last.accessibility : last.radiance);
    return out;
}

} // namespace luxel
