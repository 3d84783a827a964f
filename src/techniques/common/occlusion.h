// SPDX-License-Identifier: MIT
// The occlusion slot's machinery: an estimator is a shader that writes the accessibility of single pixels;
// everything around it (reduced buffers, the 4x4 pattern and its filter, upsampling) is here.
#pragma once
#include <functional>
#include <string_view>
#include <vector>

#include "techniques/common/occlusion_params.h"
#include "techniques/frame/frame.h"

namespace luxel {

enum class OcclusionResolution { full, half };
enum class OcclusionPattern { interleaved, none };

// Weight of an occluder at distance d, as the reference has it (docs/reference.md, `ao`).
enum class OcclusionMembership { step, sqrt, cubic, tangent, exponential };
inline const std::vector<std::string> occlusion_membership_names = {"step", "sqrt", "cubic", "tangent",
                                                                    "exponential"};

struct OcclusionOptions {
    float radius = 1.0f; // meters
    int samples = 8;
    OcclusionResolution resolution = OcclusionResolution::full;
    OcclusionPattern pattern = OcclusionPattern::interleaved;
    float thickness = 1.0f;   // of what is seen, in radii
    float depth_limit = 0.1f; // of the filter, in radii
    void visit(Visitor& v);
};

// What an estimator works on: the frame's buffers or reduced ones.
struct OcclusionBuffers {
    shared::OcclusionParams params;
    gpu::Image depth;  // R32F
    gpu::Image normal; // world, rgb; reduced: a = depth
};
OcclusionBuffers occlusion_buffers(gpu::Recorder& recorder, const Frame& frame,
                                   const OcclusionOptions& options);

// The image that the estimator writes: accessibility in r, 1 / depth in g.
gpu::Image occlusion_target(gpu::Recorder& recorder, const OcclusionBuffers& buffers,
                            const OcclusionOptions& options);

// Filter and upsampling, as far as the options ask for them: R32F, frame size.
gpu::Image finish_occlusion(gpu::Recorder& recorder, const Frame& frame, const OcclusionBuffers& buffers,
                            const OcclusionOptions& options, const gpu::Image& target);

// All of it. `shader` includes common/occlusion.glsl; its block `params` is a Params, whose first member
// `occlusion` is filled in here; `more` binds what it declares besides depth, normal and accessibility.
template <class Params> gpu::Image occlusion(gpu::Recorder& recorder, const Frame& frame,
                                             const OcclusionOptions& options, std::string_view shader,
                                             Params params, gpu::Bindings more) {
    OcclusionBuffers buffers = occlusion_buffers(recorder, frame, options);
    gpu::Image target = occlusion_target(recorder, buffers, options);
    params.occlusion = buffers.params;
    more.insert(more.end(),
                {{"depth", buffers.depth}, {"normal", buffers.normal}, {"accessibility", target}});
    recorder.dispatch(shader, extent_of(target), params, more);
    return finish_occlusion(recorder, frame, buffers, options, target);
}

// A tap table for `uniform taps { vec4 tap[OCCLUSION_MAX_SAMPLES]; }`, made by `points` when the number of
// samples or the variant changes.
class TapTable {
public:
    gpu::Buffer upload(gpu::Gpu& gpu, int samples, int variant,
                       const std::function<std::vector<glm::vec3>(int samples)>& points);

private:
    std::vector<glm::vec4> table_;
    int samples_ = 0, variant_ = 0;
};

} // namespace luxel
