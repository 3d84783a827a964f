// SPDX-License-Identifier: MIT
#include "techniques/gtao/gtao.h"

#include <algorithm>

#include "techniques/gtao/bent_params.h"

namespace luxel {

using gpu::Recorder;

void Gtao::visit(Visitor& v) {
    options_.visit(v);
    v.integer("slices", slices_, {1, 16},
              "through the view direction; each has half of its taps on each side");
    v.flag("bent_normals", bent_normals_, "make the image \"gtao bent normal\", the mean open direction");
}

namespace {

// World space, frame size, as the image "gtao bent normal".
void write_bent_normals(Recorder& recorder, const Frame& frame, const OcclusionBuffers& buffers,
                        const gpu::Image& taps) {
    const shared::ViewParams& v = frame.view;
    gpu::Image bent = recorder.image(
        {.width = frame.width, .height = frame.height, .format = VK_FORMAT_R16G16B16A16_SFLOAT},
        "gtao bent normal");
    shared::GtaoBentParams p{.right = glm::normalize(v.right),
                             .step = buffers.params.step,
                             .up = glm::normalize(v.up),
                             .limit = 0.05f,
                             .forward = v.forward};
    recorder.dispatch(
        "gtao/bent.comp", extent_of(bent), p,
        {{"taps", taps}, {"depth", frame.gbuffer.depth}, {"normal", frame.gbuffer.normal}, {"bent", bent}});
}

} // namespace

Contribution Gtao::render(Recorder& recorder, const Frame& frame) {
    auto scope = recorder.scope("gtao");
    shared::GtaoParams p{.slices = slices_, .steps = std::max(options_.samples / (2 * slices_), 1)};
    if (!bent_normals_)
        return {.accessibility = occlusion(recorder, frame, options_, "gtao/gather.comp", p, {})};

    OcclusionBuffers buffers = occlusion_buffers(recorder, frame, options_);
    gpu::Image target = occlusion_target(recorder, buffers, options_);
    gpu::Image taps = recorder.image(
        {.width = std::uint32_t(buffers.params.size.x), .height = std::uint32_t(buffers.params.size.y)},
        "gtao bent taps");
    p.occlusion = buffers.params;
    recorder.dispatch(
        "gtao/gather_bent.comp", extent_of(target), p,
        {{"depth", buffers.depth}, {"normal", buffers.normal}, {"accessibility", target}, {"bent", taps}});
    write_bent_normals(recorder, frame, buffers, taps);
    return {.accessibility = finish_occlusion(recorder, frame, buffers, options_, target)};
}

std::unique_ptr<Technique> make_gtao() { return std::make_unique<Gtao>(); }

} // namespace luxel
