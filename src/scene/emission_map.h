// SPDX-License-Identifier: MIT
// What a textured emitter sends, texel by texel: the exact mean of a triangle, and points drawn by
// brightness.
#pragma once
#include <vector>

#include "scene/scene.h"

namespace luxel {

class EmissionMap {
public:
    EmissionMap() = default; // does not vary
    // uv: barycentric weights of vertices 1 and 2. An alpha mask is not looked at.
    EmissionMap(const Scene& scene, std::uint32_t instance, std::uint32_t triangle);

    // False where the emission does not vary, or in a way that is not known by texels: the texture has no
    // area on the triangle or repeats a thousand times. Then there is neither a mean nor anything to draw.
    bool varies() const { return !cumulative_.empty(); }
    glm::vec3 mean() const { return mean_; } // radiance; of the bilinear filter's values, exact

    // Points with a density of that of uniform points x `density`, which is positive where there is light.
    struct Drawn {
        glm::vec2 uv;
        float density;
    };
    Drawn draw(glm::vec2 u) const;
    float density(glm::vec2 uv) const;

private:
    struct Polygon;
    Polygon part(int x, int y, int side) const; // of the triangle in a square of texels, which begins at x, y

    // In texels of the texture, shifted so that the filter is bilinear between whole numbers, or constant.
    glm::vec2 corners_[3];
    float area_ = 0.0f;
    int left_ = 0, top_ = 0, columns_ = 0, rows_ = 0, block_ = 1; // blocks of block_ x block_ texels
    std::vector<float> cumulative_; // share of the light up to and with each block
    glm::vec3 mean_{0.0f};
};

} // namespace luxel
