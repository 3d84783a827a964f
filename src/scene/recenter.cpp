// SPDX-License-Identifier: MIT
#include "scene/recenter.h"

#include <algorithm>
#include <cmath>

namespace luxel {
namespace {

// Half sizes that the middle may be away from the origin: up to there single precision keeps 22 bits of the
// size.
constexpr double far = 4.0;

} // namespace

void DoubleBounds::add(const Bounds& box, const glm::dmat4& transform) {
    if (box.empty()) return;
    for (int i = 0; i < 8; ++i)
        add(glm::dvec3(transform * glm::dvec4((i & 1) ? box.most.x : box.least.x,
                                              (i & 2) ? box.most.y : box.least.y,
                                              (i & 4) ? box.most.z : box.least.z, 1.0)));
}

glm::dvec3 origin_of(const DoubleBounds& bounds) {
    if (bounds.empty()) return glm::dvec3(0.0);
    const glm::dvec3 middle = (bounds.least + bounds.most) * 0.5;
    const double radius = glm::length(bounds.most - bounds.least) * 0.5;
    if (!(glm::length(middle) > far * radius) || !(radius > 0.0)) return glm::dvec3(0.0);
    const double step = std::exp2(std::floor(std::log2(radius)));
    return glm::round(middle / step) * step;
}

void move_origin(Scene& scene, const glm::dvec3& origin) {
    const glm::dvec3 by = scene.origin - origin;
    scene.origin = origin;
    if (by == glm::dvec3(0.0)) return;
    const auto moved = [&by](glm::vec3 p) { return glm::vec3(glm::dvec3(p) + by); };
    for (Instance& i : scene.instances) i.transform[3] = glm::vec4(moved(glm::vec3(i.transform[3])), 1.0f);
    for (shared::Light& light : scene.lights) light.position = moved(light.position);
    for (Camera& camera : scene.cameras) camera.position = moved(camera.position);
}

glm::dvec3 recenter(Mesh& mesh) {
    DoubleBounds bounds;
    for (const glm::vec3& p : mesh.positions) bounds.add(glm::dvec3(p));
    const glm::dvec3 middle = origin_of(bounds);
    if (middle != glm::dvec3(0.0))
        for (glm::vec3& p : mesh.positions) p = glm::vec3(glm::dvec3(p) - middle);
    return middle;
}

void recenter(Scene& scene) {
    std::vector<glm::dvec3> middles;
    for (Mesh& mesh : scene.meshes) middles.push_back(recenter(mesh));
    std::vector<Bounds> boxes(scene.meshes.size());
    for (std::size_t m = 0; m < boxes.size(); ++m)
        for (const glm::vec3& p : scene.meshes[m].positions) boxes[m].add(p);

    std::vector<glm::dmat4> transforms;
    DoubleBounds bounds;
    for (const Instance& instance : scene.instances) {
        const std::size_t mesh = std::size_t(instance.mesh);
        glm::dmat4 transform(instance.transform);
        transform[3] = transform * glm::dvec4(middles[mesh], 1.0);
        bounds.add(boxes[mesh], transform);
        transforms.push_back(transform);
    }
    const glm::dvec3 origin = origin_of(bounds);
    const bool moved =
        origin != glm::dvec3(0.0) ||
        std::any_of(middles.begin(), middles.end(), [](const glm::dvec3& m) { return m != glm::dvec3(0.0); });
    if (!moved) return;
    move_origin(scene, scene.origin + origin);
    for (std::size_t i = 0; i < transforms.size(); ++i) {
        transforms[i][3] -= glm::dvec4(origin, 0.0);
        scene.instances[i].transform = glm::mat4(transforms[i]);
    }
}

} // namespace luxel
