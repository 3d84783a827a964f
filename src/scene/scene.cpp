// SPDX-License-Identifier: MIT
// Whole-scene measures and the basis of a camera's pixel rays.
#include "scene/scene.h"

#include <cmath>

#include "core/error.h"

namespace luxel {

Bounds Scene::bounds() const {
    Bounds bounds;
    for (const Instance& instance : instances) {
        for (const glm::vec3& p : meshes[std::size_t(instance.mesh)].positions)
            bounds.add(glm::vec3(instance.transform * glm::vec4(p, 1.0f)));
    }
    return bounds;
}

std::size_t Scene::triangles() const {
    std::size_t count = 0;
    for (const Instance& instance : instances) count += meshes[std::size_t(instance.mesh)].indices.size() / 3;
    return count;
}

CameraBasis camera_basis(const Camera& camera, int width, int height) {
    LUXEL_ASSERT(width > 0 && height > 0, "width={} height={}", width, height);

    // A camera that looks along its own up vector still gets a basis: any axis across the view will do.
    glm::vec3 right = glm::cross(camera.forward, camera.up);
    if (glm::length(right) < 1e-4f) {
        const bool vertical = std::abs(camera.forward.y) > 0.9f;
        right = glm::cross(camera.forward, vertical ? glm::vec3(0, 0, -1) : glm::vec3(0, 1, 0));
    }
    right = glm::normalize(right);
    const glm::vec3 up = glm::cross(right, camera.forward);

    const float half_height = camera.orthographic() ? camera.half_height : std::tan(camera.yfov * 0.5f);
    const float half_width = half_height * float(width) / float(height);
    return {camera.position, camera.forward, right * half_width, up * half_height, camera.orthographic()};
}

} // namespace luxel
