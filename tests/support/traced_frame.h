// SPDX-License-Identifier: MIT
// A frame whose every pixel is computed from its ray: scenes with closed forms, without a renderer.
#pragma once
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "core/image.h"
#include "gpu/recorder.h"
#include "techniques/frame/frame.h"
#include "techniques/frame/projection.h"
#include "techniques/technique.h"

namespace luxel::testing {

struct TracedSurface {
    float t = 0; // along the pixel ray (component 1 along the view direction), 0 = background
    glm::vec3 normal{0}, albedo{0}, radiance{0};
};
using TraceFunction = std::function<TracedSurface(glm::vec3 origin, glm::vec3 ray)>;

// What a frame or a capture holds of such a scene.
inline Capture traced_capture(gpu::Gpu& gpu, const shared::ViewParams& view, const TraceFunction& trace) {
    const int width = int(view.width), height = int(view.height);
    Image depth(width, height, 1), normal(width, height, 4), diffuse(width, height, 4),
        direct(width, height, 4);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const glm::vec2 center{float(x) + 0.5f, float(y) + 0.5f};
            const TracedSurface s = trace(view.position, world_position(view, center, 1.0f) - view.position);
            *depth.at(x, y) = s.t;
            normal.set_rgb(x, y, s.normal);
            diffuse.set_rgb(x, y, s.albedo);
            direct.set_rgb(x, y, s.radiance);
        }
    Capture c{.width = std::uint32_t(width), .height = std::uint32_t(height), .view = view};
    c.gbuffer.depth = gpu.upload_image(depth, "depth");
    c.gbuffer.normal = c.gbuffer.geometric_normal = gpu.upload_image(normal, "normal");
    c.gbuffer.diffuse = gpu.upload_image(diffuse, "diffuse");
    c.direct = c.direct_diffuse = gpu.upload_image(direct, "direct");
    return c;
}

// Camera of 90 degrees vertically; at (0, 1, 0) looking along -z where nothing else is said.
struct TracedView {
    int width = 0, height = 0;
    glm::vec3 position{0, 1, 0}, forward{0, 0, -1};
};

// radiance: rgba, accessibility: r.
struct TracedResult {
    Image radiance, accessibility;
};

class TracedFrame {
public:
    TracedFrame(gpu::Gpu& gpu, const TracedView& at, const TraceFunction& trace) : gpu_(&gpu) {
        static_cast<Capture&>(frame) = traced_capture(gpu, view_of(at), trace);
        set_environment({});
    }

    // As the frame's environment=ambient.
    void set_environment(const shared::AmbientParams& sh) {
        frame.ambient_sh = sh;
        int width = int(frame.width), height = int(frame.height);
        Image normal = gpu_->read(frame.gbuffer.normal), diffuse = gpu_->read(frame.gbuffer.diffuse);
        Image ambient(width, height, 4);
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
                ambient.set_rgb(x, y,
                                diffuse.rgb(x, y) / shared::PI * shared::sh_irradiance(sh, normal.rgb(x, y)));
        frame.ambient = gpu_->upload_image(ambient, "ambient");
    }

    // Through the center of a pixel.
    glm::vec3 ray(int x, int y) const {
        return shared::world_position(frame.view, {float(x) + 0.5f, float(y) + 0.5f}, 1.0f) -
               frame.view.position;
    }

    TracedResult run(const std::string& technique) const {
        std::unique_ptr<Technique> t = make_technique(parse_specification(technique));
        gpu::Recorder recorder(*gpu_);
        Contribution c = t->render(recorder, frame);
        recorder.submit();
        TracedResult result;
        if (c.radiance) result.radiance = gpu_->read(c.radiance);
        if (c.accessibility) result.accessibility = gpu_->read(c.accessibility);
        return result;
    }

    Frame frame;

private:
    static shared::ViewParams view_of(const TracedView& at) {
        glm::vec3 right = glm::normalize(glm::cross(at.forward, glm::vec3(0, 1, 0)));
        return view_params({at.position, at.forward, right * (float(at.width) / float(at.height)),
                            glm::cross(right, at.forward)},
                           0.01f, 1000.0f, {float(at.width), float(at.height)});
    }
    gpu::Gpu* gpu_;
};

} // namespace luxel::testing
