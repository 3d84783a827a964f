// SPDX-License-Identifier: MIT
#include "techniques/isr/patches.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "techniques/frame/projection.h"
#include "techniques/isr/isr.h"
#include "techniques/isr/view_params.h"

namespace luxel {

using gpu::Recorder;
using shared::IsrParams;
using shared::IsrPatchParams;
using shared::ViewParams;

IsrParams isr_params(const IsrOptions& options, const Frame& frame) {
    std::uint32_t step = options.resolution == IsrResolution::half ? 2 : 1;
    IsrParams p{};
    p.view = frame.view;
    p.width = (frame.width + step - 1) / step;
    p.height = (frame.height + step - 1) / step;
    glm::vec2 size(float(p.width), float(p.height));
    p.origin = glm::ivec2(glm::ceil(options.border * size));
    p.patches = glm::ivec2(size) + 2 * p.origin;
    p.scale = float(step);
    // The image plane at distance 1 is 2|right| by 2|up| meters.
    float plane = 4.0f * glm::length(frame.view.right) * glm::length(frame.view.up);
    p.pixel_area = plane / float(frame.width * frame.height) * float(step * step);
    p.farthest = std::numeric_limits<float>::max();
    p.mode = options.mode == IsrMode::thesis ? shared::ISR_THESIS : shared::ISR_CALIBRATED;
    p.taps = options.samples;
    p.radius = std::max(options.radius * float(frame.height) / p.scale, 2.0f);
    p.inner_radius = 0.5f;
    p.grazing = options.grazing;
    p.ao_radius = options.ao_radius;
    // The thesis states neither its spacing nor its spheres: occlusion uses half the spacing of radiosity,
    // with spheres that touch each other.
    p.spacing = options.spacing;
    p.ao_stride = 0.5f;
    p.occluder = 0.5f * p.ao_stride * p.spacing;
    return p;
}

ViewParams isr_wide_view(const IsrParams& p) {
    const ViewParams& v = p.view;
    glm::vec2 size(p.patches), wider = size * p.scale / glm::vec2(v.width, v.height);
    return view_params({v.position, v.forward, v.right * wider.x, v.up * wider.y}, v.near, v.far, size);
}

std::vector<ViewParams> isr_cameras(const ViewParams& view, int count, int size) {
    glm::vec3 f = view.forward, r = glm::normalize(view.right), u = glm::normalize(view.up);
    const Axes axes[] = {{view.position, -f, -r, u},
                         {view.position, -r, f, u},
                         {view.position, r, -f, u},
                         {view.position, u, r, -f},
                         {view.position, -u, r, f}};
    LUXEL_ASSERT(count >= 0 && count <= int(std::size(axes)), "count={}", count);
    std::vector<ViewParams> views;
    for (int i = 0; i < count; ++i)
        views.push_back(view_params(axes[i], view.near, view.far, glm::vec2(float(size))));
    return views;
}

namespace {

IsrSenders make_senders(Recorder& recorder, glm::ivec2 size, const std::string& name) {
    gpu::ImageInfo info{.width = std::uint32_t(size.x), .height = std::uint32_t(size.y)};
    return {.patches = recorder.image(info, name + "patches"),
            .source = recorder.image(info, name + "source")};
}

IsrPatchParams patch_params(const IsrParams& p) {
    return {.view = p.view,
            .width = p.width,
            .height = p.height,
            .scale = p.scale,
            .pixel_area = p.pixel_area,
            .grazing = p.grazing,
            .mode = p.mode,
            .origin = p.origin};
}

gpu::Bindings capture_bindings(const Capture& c, const gpu::Image& depth, const IsrSenders& to) {
    return {{"depth", depth},
            {"geometric_normal", c.gbuffer.geometric_normal},
            {"normal", c.gbuffer.normal},
            {"diffuse", c.gbuffer.diffuse},
            {"direct_diffuse", c.direct_diffuse},
            {"patches", to.patches},
            {"source", to.source}};
}

// Every pixel of a capture as a patch, but those of the hole.
void add_capture(Recorder& recorder, const Capture& capture, const gpu::Image& depth, IsrPatchParams p,
                 const IsrSenders& to) {
    p.view = capture.view;
    p.width = capture.width, p.height = capture.height;
    p.scale = 1.0f;
    p.origin = {0, 0};
    recorder.dispatch("isr/downsample_senders.comp", {p.width, p.height}, p,
                      capture_bindings(capture, depth, to));
}

// The frame's own pixels, and around them those of a wider view.
void add_visible(Recorder& recorder, const Frame& frame, const IsrParams& p, IsrPatches& to) {
    gpu::ImageInfo info{.width = p.width, .height = p.height};
    to.visible = make_senders(recorder, p.patches, "isr ");
    to.receiver = recorder.image(info, "isr receiver");
    to.albedo = recorder.image(info, "isr albedo");
    gpu::Bindings bindings = capture_bindings(frame, frame.gbuffer.depth, to.visible);
    bindings.push_back({"receiver", to.receiver});
    bindings.push_back({"albedo", to.albedo});
    recorder.dispatch("isr/downsample.comp", extent_of(to.receiver), patch_params(p), bindings);

    if (p.origin == glm::ivec2(0)) return;
    Capture wide =
        frame.capture(recorder, {.view = isr_wide_view(p), .prefix = "isr border ", .sides = Sides::seen});
    IsrPatchParams ring = patch_params(p);
    ring.hole = p.origin, ring.hole_size = {int(p.width), int(p.height)};
    add_capture(recorder, wide, wide.gbuffer.depth, ring, to.visible);
}

// The surfaces next behind the visible ones.
IsrSenders find_hidden(Recorder& recorder, const Frame& frame, const IsrParams& p, float separation,
                       const IsrSenders& visible) {
    gpu::ImageInfo info = visible.patches.info();
    info.format = VK_FORMAT_R32_SFLOAT;
    gpu::Image depth = recorder.image(info, "isr peel depth");
    recorder.dispatch("isr/peel_depth.comp", extent_of(depth), shared::IsrPeelParams{separation},
                      {{"patches", visible.patches}, {"depth", depth}});
    Capture behind = frame.capture(
        recorder,
        {.view = isr_wide_view(p), .prefix = "isr hidden ", .farther_than = depth, .behind_frame = true});
    IsrSenders hidden = make_senders(recorder, p.patches, "isr hidden ");
    add_capture(recorder, behind, behind.gbuffer.depth, patch_params(p), hidden);
    return hidden;
}

// What an additional camera sees and the frame's patches do not show.
IsrSenders find_unseen(Recorder& recorder, const Frame& frame, const IsrParams& p, const ViewParams& camera,
                       const IsrSenders& visible) {
    Capture capture = frame.capture(recorder, {.view = camera, .prefix = "isr camera "});
    gpu::Image unseen = recorder.image(
        {.width = capture.width, .height = capture.height, .format = VK_FORMAT_R32_SFLOAT}, "isr unseen");
    // A fiftieth of the depth: patches are as thick as their slant within a coarse pixel.
    shared::IsrUnseenParams u{.view = p.view,
                              .camera = camera,
                              .origin = p.origin,
                              .patches = p.patches,
                              .scale = p.scale,
                              .tolerance = 0.02f};
    recorder.dispatch("isr/unseen.comp", extent_of(unseen), u,
                      {{"depth", capture.gbuffer.depth}, {"patches", visible.patches}, {"unseen", unseen}});

    IsrPatchParams pixels = patch_params(p);
    pixels.pixel_area =
        4.0f * glm::length(camera.right) * glm::length(camera.up) / (camera.width * camera.height);
    IsrSenders senders = make_senders(recorder, {int(capture.width), int(capture.height)}, "isr camera ");
    senders.view = camera;
    add_capture(recorder, capture, unseen, pixels, senders);
    return senders;
}

} // namespace

IsrPatches isr_patches(Recorder& recorder, const Frame& frame, const IsrOptions& options,
                       const IsrParams& p) {
    IsrPatches all;
    add_visible(recorder, frame, p, all);
    if (options.layers > 1) all.hidden = find_hidden(recorder, frame, p, options.separation, all.visible);
    for (const ViewParams& camera : isr_cameras(frame.view, options.cameras, int(p.height)))
        if (touches(frustum_of(camera.world_to_clip), frame.scene->bounds()))
            all.cameras.push_back(find_unseen(recorder, frame, p, camera, all.visible));
    return all;
}

} // namespace luxel
