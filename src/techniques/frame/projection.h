// SPDX-License-Identifier: MIT
// Projections of cameras and shadow maps. Depth is reversed (1 near, 0 far): a 32-bit float keeps equal
// relative precision at every distance then.
#pragma once
#include "scene/scene.h"
#include "techniques/frame/view_params.h"

namespace luxel {

// A position with axes; right and up are scaled by the half extents at distance 1 (perspective) or of the box
// (orthographic).
struct Axes {
    glm::vec3 position, forward, right, up;
};

// Clip w = distance along forward, depth = near / w; no far plane.
glm::mat4 perspective_to_clip(const Axes& axes, float near);
// Depth = 1 at `nearest`, 0 at `farthest`, both distances along forward from the position.
glm::mat4 orthographic_to_clip(const Axes& axes, float nearest, float farthest);

shared::ViewParams view_params(const Axes& axes, float near, float far, glm::vec2 size);
// Orthographic: axes scaled by the half extents; sees 0 to `far` along forward.
shared::ViewParams parallel_view_params(const Axes& axes, float far, glm::vec2 size);
// Orthographic cameras' views begin at their near plane and, so that depth is precise, end behind `scene`.
shared::ViewParams view_params(const Camera& camera, int width, int height, const Bounds& scene = {});

} // namespace luxel
