// SPDX-License-Identifier: MIT
#include "techniques/frame/projection.h"

#include <algorithm>

namespace luxel {
namespace {

// dot((row, 1), (p - position, 1)) as a row of a matrix.
glm::vec4 relative_row(glm::vec3 row, glm::vec3 position, float constant) {
    return {row, constant - glm::dot(row, position)};
}

// Row that gives 1 at the tip of a scaled axis.
glm::vec3 unit_at_tip(glm::vec3 axis) { return axis / glm::dot(axis, axis); }

} // namespace

glm::mat4 perspective_to_clip(const Axes& a, float near) {
    return glm::transpose(glm::mat4(relative_row(unit_at_tip(a.right), a.position, 0.0f),
                                    relative_row(unit_at_tip(a.up), a.position, 0.0f),
                                    glm::vec4(0.0f, 0.0f, 0.0f, near),
                                    relative_row(a.forward, a.position, 0.0f)));
}

glm::mat4 orthographic_to_clip(const Axes& a, float nearest, float farthest) {
    float scale = 1.0f / (nearest - farthest);
    return glm::transpose(glm::mat4(relative_row(unit_at_tip(a.right), a.position, 0.0f),
                                    relative_row(unit_at_tip(a.up), a.position, 0.0f),
                                    relative_row(a.forward * scale, a.position, -farthest * scale),
                                    glm::vec4(0.0f, 0.0f, 0.0f, 1.0f)));
}

shared::ViewParams view_params(const Axes& axes, float near, float far, glm::vec2 size) {
    shared::ViewParams v{};
    v.world_to_clip = perspective_to_clip(axes, near);
    v.position = axes.position, v.forward = axes.forward, v.right = axes.right, v.up = axes.up;
    v.near = near, v.far = far;
    v.width = size.x, v.height = size.y;
    return v;
}

shared::ViewParams parallel_view_params(const Axes& axes, float far, glm::vec2 size) {
    shared::ViewParams v = view_params(axes, 0.0f, far, size);
    v.world_to_clip = orthographic_to_clip(axes, 0.0f, far);
    v.parallel = 1.0f;
    return v;
}

shared::ViewParams view_params(const Camera& camera, int width, int height, const Bounds& scene) {
    const CameraBasis b = camera_basis(camera, width, height);
    const glm::vec2 size(width, height);
    if (!camera.orthographic())
        return view_params({b.position, b.forward, b.right, b.up}, camera.near, camera.far, size);

    // The corner of the scene that is farthest along the view, and a little more, is far enough.
    const glm::vec3 corner = glm::mix(scene.least, scene.most, glm::greaterThan(b.forward, glm::vec3(0.0f)));
    const float behind = scene.empty() ? 1.0f : glm::dot(corner - b.position, b.forward);
    const float far = std::min(camera.far - camera.near, std::max(1.001f * (behind - camera.near), 1e-6f));
    return parallel_view_params({b.position + b.forward * camera.near, b.forward, b.right, b.up}, far, size);
}

} // namespace luxel
