// SPDX-License-Identifier: MIT
#include "techniques/common/occlusion.h"

#include <glm/gtc/quaternion.hpp>

namespace luxel {

using gpu::Recorder;

void OcclusionOptions::visit(Visitor& v) {
    v.real("radius", radius, {0.001, 1000}, "meters within which surfaces occlude");
    v.integer("samples", samples, {1, double(shared::OCCLUSION_MAX_SAMPLES)}, "taps per pixel");
    v.choice("resolution", resolution, {"full", "half"},
             "size of the buffers; half is upsampled bilaterally");
    v.choice("pattern", pattern, {"interleaved", "none"},
             "interleaved: taps turn within blocks of 4x4 pixels, which a filter averages; none: neither");
    v.real("thickness", thickness, {0.001, 1e6},
           "radii behind a visible surface that count as solid; farther behind is open");
    v.only_if(pattern == OcclusionPattern::interleaved, "pattern=interleaved", [&] {
        v.real("depth_limit", depth_limit, {0.0001, 1e6},
               "radii of depth off a pixel's plane beyond which the filter leaves neighbors out");
    });
}

namespace {

int step_of(const OcclusionOptions& options) {
    return options.resolution == OcclusionResolution::half ? 2 : 1;
}

shared::OcclusionParams make_params(const OcclusionOptions& options, const Frame& frame) {
    const shared::ViewParams& v = frame.view;
    const int step = step_of(options);
    shared::OcclusionParams p{};
    glm::quat rotation =
        glm::quat_cast(glm::transpose(glm::mat3(glm::normalize(v.right), glm::normalize(v.up), -v.forward)));
    p.world_to_camera = {rotation.x, rotation.y, rotation.z, rotation.w};
    p.radius = options.radius;
    p.thickness = options.thickness * options.radius;
    p.samples = options.samples;
    // Pixel q of the buffers is pixel q step of the frame, whose center is at q step + 1/2.
    glm::vec2 half{glm::length(v.right), -glm::length(v.up)};
    glm::vec2 size{v.width, v.height};
    p.ray_scale = 2.0f * half * float(step) / size;
    p.ray_offset = half / size - half;
    p.size = (glm::ivec2(int(frame.width), int(frame.height)) + (step - 1)) / step;
    p.step = step;
    p.interleaved = options.pattern == OcclusionPattern::interleaved ? 1u : 0u;
    return p;
}

gpu::Image buffer_image(Recorder& recorder, const shared::OcclusionParams& p, VkFormat format,
                        const char* name) {
    return recorder.image(
        {.width = std::uint32_t(p.size.x), .height = std::uint32_t(p.size.y), .format = format}, name);
}

} // namespace

OcclusionBuffers occlusion_buffers(Recorder& recorder, const Frame& frame, const OcclusionOptions& options) {
    OcclusionBuffers b{make_params(options, frame), frame.gbuffer.depth, frame.gbuffer.normal};
    if (step_of(options) == 1) return b;
    gpu::Image depth = buffer_image(recorder, b.params, VK_FORMAT_R32_SFLOAT, "occlusion depth");
    gpu::Image guide = buffer_image(recorder, b.params, VK_FORMAT_R32G32B32A32_SFLOAT, "occlusion guide");
    recorder.dispatch("common/occlusion_reduce.comp", extent_of(depth), Recorder::NoParams{},
                      {{"depth", b.depth}, {"normal", b.normal}, {"small_depth", depth}, {"guide", guide}});
    b.depth = depth, b.normal = guide;
    return b;
}

gpu::Image occlusion_target(Recorder& recorder, const OcclusionBuffers& buffers,
                            const OcclusionOptions& options) {
    // Without later passes the estimator writes the result itself.
    bool last = options.pattern == OcclusionPattern::none && step_of(options) == 1;
    return buffer_image(recorder, buffers.params, last ? VK_FORMAT_R32_SFLOAT : VK_FORMAT_R32G32_SFLOAT,
                        last ? "accessibility" : "accessibility taps");
}

gpu::Image finish_occlusion(Recorder& recorder, const Frame& frame, const OcclusionBuffers& buffers,
                            const OcclusionOptions& options, const gpu::Image& target) {
    gpu::Image result = target;
    const bool upsample = step_of(options) > 1;
    if (options.pattern == OcclusionPattern::interleaved) {
        gpu::Image row = buffer_image(recorder, buffers.params, VK_FORMAT_R32G32_SFLOAT, "accessibility row");
        gpu::Image box =
            buffer_image(recorder, buffers.params, upsample ? VK_FORMAT_R32G32_SFLOAT : VK_FORMAT_R32_SFLOAT,
                         upsample ? "accessibility box" : "accessibility");
        shared::OcclusionFilterParams p{{1, 0}, options.depth_limit * options.radius};
        recorder.dispatch("common/occlusion_filter.comp", extent_of(row), p, {{"from", target}, {"to", row}});
        p.direction = {0, 1};
        recorder.dispatch("common/occlusion_filter.comp", extent_of(box), p, {{"from", row}, {"to", box}});
        result = box;
    }
    if (!upsample) return result;

    gpu::Image full = recorder.image(
        {.width = frame.width, .height = frame.height, .format = VK_FORMAT_R32_SFLOAT}, "accessibility");
    shared::OcclusionUpsampleParams p{{int(frame.width), int(frame.height)}, float(step_of(options))};
    recorder.dispatch("common/occlusion_upsample.comp", extent_of(full), p,
                      {{"from", result},
                       {"guide", buffers.normal},
                       {"depth", frame.gbuffer.depth},
                       {"normal", frame.gbuffer.normal},
                       {"accessibility", full}});
    return full;
}

gpu::Buffer TapTable::upload(gpu::Gpu& gpu, int samples, int variant,
                             const std::function<std::vector<glm::vec3>(int)>& points) {
    if (samples != samples_ || variant != variant_) {
        table_.assign(std::size_t(shared::OCCLUSION_MAX_SAMPLES), glm::vec4(0.0f));
        std::vector<glm::vec3> made = points(samples);
        for (std::size_t i = 0; i < made.size(); ++i) table_[i] = glm::vec4(made[i], 0.0f);
        samples_ = samples, variant_ = variant;
    }
    return gpu.upload(std::span<const glm::vec4>(table_), "occlusion taps");
}

} // namespace luxel
