// SPDX-License-Identifier: MIT
#include "reference/media.h"

#include <algorithm>
#include <cmath>

namespace luxel {
namespace {

bool is_solid(const Surface& s) { return !s.material->thin && s.transmission > 0.0f; }

} // namespace

glm::vec3 attenuation(const Material& m, float distance) {
    if (!std::isfinite(m.attenuation_distance) || m.attenuation_color == glm::vec3(1.0f))
        return glm::vec3(1.0f);
    return glm::pow(m.attenuation_color, glm::vec3(distance / m.attenuation_distance));
}

void Media::leave(const Surface& s, glm::vec3 direction) {
    const bool to_front = glm::dot(s.geometric_normal, direction) > 0.0f;
    if (!is_solid(s) || to_front == s.front) return;
    if (s.front) {
        if (count_ == inside_.size())
            std::move(inside_.begin() + 1, inside_.end(), inside_.begin()), --count_;
        inside_[count_++] = s.material;
        return;
    }
    // The innermost of this material: solids that overlap are left in any order.
    for (std::size_t i = count_; i-- > 0;)
        if (inside_[i] == s.material) {
            std::move(inside_.begin() + std::ptrdiff_t(i) + 1, inside_.begin() + std::ptrdiff_t(count_),
                      inside_.begin() + std::ptrdiff_t(i));
            --count_;
            return;
        }
}

glm::vec3 Media::transmittance(float distance, const Surface* met) const {
    const bool around = met && is_solid(*met) && !met->front;
    const auto end = inside_.begin() + std::ptrdiff_t(count_);
    if (around && std::find(inside_.begin(), end, met->material) == end)
        return attenuation(*met->material, distance);
    return empty() ? glm::vec3(1.0f) : attenuation(*inside_[count_ - 1], distance);
}

} // namespace luxel
