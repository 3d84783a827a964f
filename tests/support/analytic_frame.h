// SPDX-License-Identifier: MIT
// A G-buffer of planes, each pixel computed from its ray: exact input for the closed forms of screen-space
// techniques.
#pragma once
#include <vector>

#include <glm/gtc/packing.hpp>

#include "techniques/frame/frame.h"
#include "techniques/frame/projection.h"

namespace luxel::testing {

struct Plane {
    glm::vec3 point, normal; // unit; seen from the side that the normal points to
};

struct AnalyticFrame {
    Frame frame;
    std::vector<glm::vec3> position; // of each pixel's surface, row by row; zero where there is none
    std::vector<int> plane;          // index of the plane seen, -1 = background

    std::size_t index(int x, int y) const { return std::size_t(y) * frame.width + std::size_t(x); }
};

// Depth, normal and geometric normal as the frame stores them: normals have gone through 16 bits.
inline AnalyticFrame analytic_frame(gpu::Gpu& gpu, const Camera& camera, int width, int height,
                                    const std::vector<Plane>& planes) {
    AnalyticFrame a;
    a.frame.width = std::uint32_t(width), a.frame.height = std::uint32_t(height);
    a.frame.camera = camera;
    a.frame.view = view_params(camera, width, height);
    const shared::ViewParams& v = a.frame.view;
    Image depth(width, height, 1), normal(width, height, 4);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            glm::vec3 ray = world_position(v, {float(x) + 0.5f, float(y) + 0.5f}, 1.0f) - v.position;
            float nearest = 0.0f;
            int seen = -1;
            for (std::size_t i = 0; i < planes.size(); ++i) {
                float facing = glm::dot(planes[i].normal, ray);
                float z = glm::dot(planes[i].normal, planes[i].point - v.position) / facing;
                if (facing < 0.0f && z > 0.0f && (seen < 0 || z < nearest)) nearest = z, seen = int(i);
            }
            a.plane.push_back(seen);
            a.position.push_back(seen < 0 ? glm::vec3(0.0f) : v.position + ray * nearest);
            if (seen < 0) continue;
            *depth.at(x, y) = nearest;
            glm::vec4 n(planes[std::size_t(seen)].normal, 1.0f);
            for (int c = 0; c < 4; ++c) normal.at(x, y)[c] = glm::unpackHalf1x16(glm::packHalf1x16(n[c]));
        }
    a.frame.gbuffer.depth = gpu.upload_image(depth, "depth");
    a.frame.gbuffer.normal = a.frame.gbuffer.geometric_normal = gpu.upload_image(normal, "normal");
    return a;
}

} // namespace luxel::testing
