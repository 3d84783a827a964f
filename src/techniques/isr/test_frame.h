// SPDX-License-Identifier: MIT
// Test only: frames whose every pixel is computed from its ray, and closed forms for them.
#pragma once
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "support/traced_frame.h"
#include "techniques/isr/isr.h"

namespace luxel::testing {

using Analytic = TracedSurface;
using AnalyticScene = TraceFunction;

// 90 degrees high, at (x, 1, 0) looking along -z.
inline shared::ViewParams view_from(float x, int width, int height) {
    return view_params({{x, 1, 0}, {0, 0, -1}, {float(width) / float(height), 0, 0}, {0, 1, 0}}, 0.01f,
                       1000.0f, {float(width), float(height)});
}

// One triangle whose bounds no view misses.
inline Scene everywhere() {
    Scene s;
    s.materials.emplace_back();
    s.meshes.push_back({.positions = {glm::vec3(-1e3f), glm::vec3(1e3f), glm::vec3(1e3f, 0, -1e3f)},
                        .normals = {{0, 1, 0}, {0, 1, 0}, {0, 1, 0}},
                        .indices = {0, 1, 2}});
    s.instances.emplace_back();
    return s;
}

struct IsrTestFrame {
    gpu::Gpu gpu{{.validation = true}};
    Scene bounds = everywhere();
    GpuScene on_gpu{gpu, bounds, false};
    AnalyticScene scene;
    AnalyticScene hidden = [](glm::vec3, glm::vec3) { return Analytic{}; }; // what captures peel out
    Frame frame;

    IsrTestFrame(int width, int height, AnalyticScene s) : scene(std::move(s)) {
        see(view_from(0, width, height));
        frame.capture = [this](gpu::Recorder&, const CaptureRequest& request) {
            return trace(request.farther_than ? hidden : scene, request.view);
        };
    }

    void see(const shared::ViewParams& view) { static_cast<Capture&>(frame) = trace(scene, view); }

    Capture trace(const AnalyticScene& what, const shared::ViewParams& v) {
        Capture c = traced_capture(gpu, v, what);
        c.scene = &on_gpu;
        return c;
    }

    // rgb = radiance, in the second image r = accessibility.
    std::pair<Image, Image> run(Isr& isr) {
        gpu::Recorder recorder(gpu);
        Contribution c = isr.render(recorder, frame);
        recorder.submit();
        EXPECT_TRUE(gpu.validation_messages().empty());
        return {gpu.read(c.radiance), gpu.read(c.accessibility)};
    }
    std::pair<Image, Image> run(const std::vector<std::pair<std::string, std::string>>& options) {
        Isr isr;
        set_parameters(isr, "isr", options);
        return run(isr);
    }
};

// Floor y = 0 (black source, albedo 1) that ends at a wall z = -2 (radiance 1, no albedo).
inline Analytic floor_and_wall(glm::vec3 o, glm::vec3 ray) {
    float to_floor = ray.y < 0 ? -o.y / ray.y : 1e30f, to_wall = ray.z < 0 ? (2.0f + o.z) / -ray.z : 1e30f;
    if (std::min(to_floor, to_wall) > 1e29f) return {};
    if (to_floor < to_wall) return {to_floor, {0, 1, 0}, glm::vec3(1), glm::vec3(0)};
    return {to_wall, {0, 0, 1}, glm::vec3(0), glm::vec3(1)};
}

// Form factor from a point at distance c of a perpendicular rectangle's edge, opposite to one of its corners,
// to the rectangle of width b along that edge and height a (Hottel and Sarofim's configuration B-4).
inline double corner_form_factor(double a, double b, double c) {
    double x = a / b, y = c / b, s = std::sqrt(x * x + y * y);
    return (std::atan(1 / y) - y / s * std::atan(1 / s)) / (2 * std::numbers::pi);
}

inline double mean_over_block(const Image& image, int x0, int y0, int size) {
    double sum = 0;
    for (int y = y0; y < y0 + size; ++y)
        for (int x = x0; x < x0 + size; ++x) sum += image.at(x, y)[0];
    return sum / (size * size);
}

// z of the floor where an image row's lower border meets it.
inline double floor_z(const shared::ViewParams& v, float row) {
    glm::vec3 ray = world_position(v, {v.width / 2, row}, 1.0f) - v.position;
    return double(ray.z) * (-1.0 / double(ray.y));
}

} // namespace luxel::testing
