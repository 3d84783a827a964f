// SPDX-License-Identifier: MIT
#include "scene/export/sky.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"
#include "shared/sampling.h"

namespace luxel {

glm::vec3 equal_area_direction(glm::vec2 square) {
    const float u = 2.0f * square.x - 1.0f, v = 2.0f * square.y - 1.0f;
    const float inside = 1.0f - (std::abs(u) + std::abs(v)); // negative beyond the upper hemisphere's diamond
    const float r = 1.0f - std::abs(inside);
    const float phi = (r == 0.0f ? 1.0f : (std::abs(v) - std::abs(u)) / r + 1.0f) * shared::PI / 4.0f;
    const float radius = r * std::sqrt(2.0f - r * r);
    return {std::copysign(std::cos(phi), u) * radius, std::copysign(std::sin(phi), v) * radius,
            std::copysign(1.0f - r * r, inside)};
}

Image equal_area_sky(const Environment& environment) {
    constexpr int samples = 4; // a side, of each texel
    const Image& map = environment.radiance;
    const int side = std::clamp(int(std::ceil(std::sqrt(double(map.pixels())))), 16, 8192);
    Image sky(side, side, 3);
    parallel_for(std::size_t(side), 4, [&](std::size_t y) {
        for (int x = 0; x < side; ++x) {
            glm::vec3 sum(0.0f);
            for (int i = 0; i < samples * samples; ++i) {
                const glm::vec2 place(float(x) + (float(i % samples) + 0.5f) / samples,
                                      float(y) + (float(i / samples) + 0.5f) / samples);
                sum += evaluate(environment, equal_area_direction(place / float(side)));
            }
            sky.set_rgb(x, int(y), sum / float(samples * samples));
        }
    });
    return sky;
}

float mitsuba_sky_angle(const Environment& environment) {
    return 180.0f + environment.rotation * (180.0f / shared::PI);
}

} // namespace luxel
