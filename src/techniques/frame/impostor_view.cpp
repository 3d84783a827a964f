// SPDX-License-Identifier: MIT
#include "techniques/frame/impostor_view.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "techniques/frame/projection.h"

namespace luxel {
namespace {

// Of the grid on the box's surface. Corners alone can be 13 % too small, this grid 0.03 % (both the worst of
// 3000 random views).
constexpr int edge_points = 9, last = edge_points - 1;

glm::vec3 corner_of(const Bounds& b, int i) {
    return {(i & 1) ? b.most.x : b.least.x, (i & 2) ? b.most.y : b.least.y, (i & 4) ? b.most.z : b.least.z};
}

} // namespace

std::optional<shared::ViewParams> impostor_view(const Bounds& bounds, const shared::ViewParams& camera,
                                                int size) {
    // Upright as the camera is, so that texels lie along pixels.
    const glm::vec3 toward = bounds.center() - camera.position;
    const float distance = glm::length(toward);
    if (!(distance > 0.0f)) return std::nullopt;
    const glm::vec3 forward = toward / distance;
    const glm::vec3 aside = glm::cross(forward, camera.up);
    const bool upright = glm::length(aside) > 1e-3f * glm::length(camera.up);
    const glm::vec3 right = glm::normalize(upright ? aside : glm::cross(forward, camera.right));
    const glm::vec3 up = glm::cross(right, forward);

    float half = 0.0f, nearest = distance;
    for (int i = 0; i < 8; ++i) {
        const glm::vec3 p = corner_of(bounds, i) - camera.position;
        const float z = glm::dot(p, forward);
        if (z <= camera.near) return std::nullopt;
        half = std::max({half, std::abs(glm::dot(p, right)) / z, std::abs(glm::dot(p, up)) / z});
        nearest = std::min(nearest, z);
    }
    if (!(half > 0.0f) || half > 1.0f) return std::nullopt;
    half *= float(size) / float(size - 2);
    return view_params({camera.position, forward, right * half, up * half}, nearest,
                       std::numeric_limits<float>::max(), glm::vec2(float(size)));
}

shared::ImpostorCard card_of(const shared::ViewParams& view, float depth) {
    return {.corner = view.position + (view.forward - view.right + view.up) * depth,
            .edge_u = view.right * (2.0f * depth),
            .edge_v = view.up * (-2.0f * depth),
            .first = glm::vec2(0.0f),
            .size = {view.width, view.height},
            .eye = view.position,
            .forward = view.forward,
            .depth = depth,
            .turn = glm::mat3(1.0f)};
}

float balanced_depth(const Bounds& bounds, const shared::ViewParams& view) {
    float nearest = std::numeric_limits<float>::max(), farthest = 0.0f;
    for (int i = 0; i < 8; ++i) {
        const float z = glm::dot(corner_of(bounds, i) - view.position, view.forward);
        nearest = std::min(nearest, z), farthest = std::max(farthest, z);
    }
    return 2.0f / (1.0f / nearest + 1.0f / farthest);
}

float displacement(glm::vec3 point, const shared::ImpostorCard& card, const shared::ViewParams& camera) {
    const glm::vec3 a = point - camera.position, b = shown_on_card(card, point) - camera.position;
    const float cosine = glm::dot(a, b), sine = glm::length(glm::cross(a, b));
    if (!(cosine > 0.0f)) return std::numeric_limits<float>::max();
    const float pixel = 2.0f * glm::length(camera.up) / camera.height; // at distance 1
    return sine / cosine / pixel;
}

float displacement(const Bounds& bounds, const shared::ImpostorCard& card, const shared::ViewParams& camera) {
    // The largest is on the surface, since on a ray from the card's eye it grows away from the card.
    float largest = 0.0f;
    for (int i = 0; i < edge_points; ++i)
        for (int j = 0; j < edge_points; ++j)
            for (int k = 0; k < edge_points; ++k) {
                const bool inside = i % last > 0 && j % last > 0 && k % last > 0;
                if (inside) continue;
                const glm::vec3 at = glm::vec3(float(i), float(j), float(k)) / float(last);
                const glm::vec3 point = glm::mix(bounds.least, bounds.most, at);
                largest = std::max(largest, displacement(point, card, camera));
            }
    return largest;
}

} // namespace luxel
