// SPDX-License-Identifier: MIT
#include "techniques/frame/capture.h"

#include "core/error.h"
#include "techniques/frame/gbuffer.h"

namespace luxel {

Capture capture_images(gpu::Recorder& recorder, const GpuScene& scene, const CaptureRequest& request) {
    Capture c{.width = std::uint32_t(request.view.width),
              .height = std::uint32_t(request.view.height),
              .view = request.view,
              .scene = &scene};
    auto image = [&](VkFormat format, const char* name) {
        return recorder.image({.width = c.width, .height = c.height, .format = format},
                              request.prefix + name);
    };
    c.gbuffer = {.diffuse = image(VK_FORMAT_R16G16B16A16_SFLOAT, "diffuse"),
                 .specular = image(VK_FORMAT_R16G16B16A16_SFLOAT, "specular"),
                 .normal = image(VK_FORMAT_R16G16B16A16_SFLOAT, "normal"),
                 .geometric_normal = image(VK_FORMAT_R16G16B16A16_SFLOAT, "geometric_normal"),
                 .depth = image(VK_FORMAT_R32_SFLOAT, "depth"),
                 .hardware_depth = image(VK_FORMAT_D32_SFLOAT, "hardware_depth")};
    c.direct = image(VK_FORMAT_R32G32B32A32_SFLOAT, "direct");
    c.direct_diffuse = image(VK_FORMAT_R32G32B32A32_SFLOAT, "direct_diffuse");
    return c;
}

Capture capture_surfaces(gpu::Recorder& recorder, const GpuScene& scene, const CaptureRequest& request,
                         const std::optional<shared::HeightSearch>& search) {
    const gpu::Image& behind = request.farther_than;
    LUXEL_ASSERT(!behind || (float(behind.width()) == request.view.width &&
                             float(behind.height()) == request.view.height),
                 "view {}x{}, depth {}x{}", request.view.width, request.view.height, behind.width(),
                 behind.height());
    Capture c = capture_images(recorder, scene, request);
    c.search = search;
    draw_gbuffer(recorder, c, request);
    recorder.clear(c.direct_diffuse, {});
    return c;
}

} // namespace luxel
