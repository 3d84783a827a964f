// SPDX-License-Identifier: MIT
// The frames of one view: the base once, and each row's techniques on top of it.
#pragma once
#include <functional>
#include <vector>

#include "experiments/row_cost.h"
#include "experiments/technique_rows.h"
#include "techniques/frame/renderer.h"

namespace luxel {

// One view to evaluate.
struct ViewTask {
    Camera camera;
    int width = 640, height = 480;
    int timed_frames = 5;
    bool pixel_area = false; // of a supersampled frame: the truth integrates the pixels, too
};

struct RowFrames {
    Image image; // of the last frame: radiance, or the accessibility
    RowCost cost;
    std::vector<gpu::PassTime> passes; // medians: the base frame's, then the row's
    std::uint64_t memory_bytes = 0;
    std::vector<std::string> warnings; // of its techniques
};

class ViewFrames {
public:
    // Draws the base frame. `step` is called before each frame and may throw to stop.
    ViewFrames(Renderer& renderer, const ViewTask& task, bool accessibility, std::function<void()> step);
    const RowFrames& baseline() const { return baseline_; }
    const Image& mask() const { return mask_; }
    // Its first frame is not timed. Error Fault::usage: it has no accessibility, where that is asked for.
    RowFrames row(const TechniqueRow& row);

private:
    RenderRequest request() const;
    // Timed frames after one that is not.
    std::vector<std::vector<gpu::PassTime>> base_frames(const std::vector<Technique*>& techniques);
    std::vector<double> without_base(const std::vector<std::vector<gpu::PassTime>>& frames) const;

    Renderer& renderer_;
    const ViewTask& task_;
    bool accessibility_;
    std::function<void()> step_;
    BaseFrame base_;                    // the last that was drawn
    bool base_is_plain_ = false;        // without height maps
    std::vector<std::string> composed_; // the passes that every frame ends with
    RowFrames baseline_;
    std::vector<gpu::PassTime> base_passes_; // medians
    Image mask_;
};

} // namespace luxel
