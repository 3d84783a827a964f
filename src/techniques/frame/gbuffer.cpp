// SPDX-License-Identifier: MIT
#include "techniques/frame/gbuffer.h"

#include <span>

#include "techniques/frame/displaced_params.h"

namespace luxel {
namespace {

// Shares of the sides that are left out, see gbuffer_fragment.glsl.
shared::PeelParams peel_params(const Capture& capture, const CaptureRequest& request) {
    shared::PeelParams p{.view = capture.view,
                         .blended = !request.blended       ? 0.0f
                                    : request.farther_than ? 2.0f
                                                           : 1.0f};
    const Sides sides = request.sides;
    if (sides == Sides::standard) p.drop_solid_back = 1.0f;
    if (sides == Sides::front) p.drop_back = 1.0f;
    if (sides == Sides::back) p.drop_front = 1.0f;
    return p;
}

// Nothing is nearer than this.
gpu::Image at_the_eye(gpu::Recorder& recorder, const Capture& capture) {
    gpu::Image zero = recorder.image(
        {.width = capture.width, .height = capture.height, .format = VK_FORMAT_R32_SFLOAT}, "at the eye");
    recorder.clear(zero, {});
    return zero;
}

// Parts of the scene by what is to be left out of them.
struct Part {
    Facing facing;
    gpu::Cull cull;
};
constexpr Part whole[] = {{Facing::any, gpu::Cull::none}};
constexpr Part seen_parts[] = {{Facing::both, gpu::Cull::none},
                               {Facing::front, gpu::Cull::back},
                               {Facing::mirrored_front, gpu::Cull::front}};

} // namespace

gpu::RasterPass gbuffer_pass(const Capture& capture) {
    const GBuffer& g = capture.gbuffer;
    gpu::RasterPass pass{.depth = gpu::DepthTarget{.image = g.hardware_depth,
                                                   .clear = 0.0f,
                                                   .compare = VK_COMPARE_OP_GREATER_OR_EQUAL}};
    const std::array<float, 4> black{};
    for (const gpu::Image& image :
         {g.diffuse, g.specular, g.normal, g.geometric_normal, g.depth, capture.direct})
        pass.color.push_back({image, black});
    return pass;
}

void load_targets(gpu::RasterPass& pass) {
    for (gpu::ColorTarget& target : pass.color) target.clear.reset();
    pass.depth->clear.reset();
}

void draw_gbuffer(gpu::Recorder& recorder, const Capture& capture, const CaptureRequest& request) {
    auto scope = recorder.scope("gbuffer");
    const GpuScene& scene = *capture.scene;
    const Frustum frustum = frustum_of(capture.view.world_to_clip);
    const bool one_side = request.sides == Sides::front || request.sides == Sides::back;
    const bool peels = request.farther_than || one_side || request.blended;
    const std::span<const Part> parts =
        request.sides == Sides::seen ? std::span<const Part>(seen_parts) : std::span<const Part>(whole);

    // Depth of what is opaque comes first, so that each pixel is shaded about once. It cannot peel: which
    // surfaces have a back is their material's business. Reliefs are where their search ends.
    const bool apart = capture.search.has_value();
    gpu::RasterPass pass = gbuffer_pass(capture);
    for (const Part& part : parts) {
        if (peels) break;
        const std::vector<gpu::Batch> batches =
            scene.batches(frustum, Surfaces::opaque, MaterialUse::none, request.drawn, apart, part.facing);
        if (batches.empty() && !pass.depth->clear) continue;
        recorder.draw("frame/depth", {.depth = pass.depth, .cull = part.cull}, capture.view.world_to_clip,
                      scene.vertex_bindings(MaterialUse::none), scene.indices(), batches);
        pass.depth->clear.reset();
    }

    // One program for each kind of material; the first clears.
    gpu::Bindings bindings = scene.vertex_bindings(MaterialUse::all);
    if (peels)
        bindings.push_back(
            {"farther_than", request.farther_than ? request.farther_than : at_the_eye(recorder, capture)});
    const auto draw_kind = [&](const SurfaceProgram& kind, const Part& part) {
        const std::vector<gpu::Batch> batches =
            scene.batches(frustum, kind.surfaces, MaterialUse::all, request.drawn, apart, part.facing);
        if (batches.empty() && !pass.color[0].clear) return;
        pass.cull = part.cull;
        if (peels)
            recorder.draw(kind.peeling, pass, peel_params(capture, request), bindings, scene.indices(),
                          batches);
        else
            recorder.draw(kind.program, pass, capture.view, bindings, scene.indices(), batches);
        load_targets(pass);
    };
    for (const SurfaceProgram& kind : surface_programs)
        for (const Part& part : parts) draw_kind(kind, part);
    for (const Part& part : parts) {
        if (!apart) break;
        const std::vector<gpu::Batch> reliefs =
            scene.batches(frustum, Surfaces::displaced, MaterialUse::all, request.drawn, false, part.facing);
        if (reliefs.empty()) continue;
        pass.cull = part.cull;
        recorder.draw(peels ? "frame/peel_displaced" : "frame/gbuffer_displaced", pass,
                      shared::DisplacedParams{peel_params(capture, request), *capture.search}, bindings,
                      scene.indices(), reliefs);
    }
}

} // namespace luxel
