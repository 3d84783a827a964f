// SPDX-License-Identifier: MIT
// Environment maps: mapping between directions and texels, and sampling by importance.
// The radiance is constant within a texel, exactly as evaluate() reads it.
#pragma once
#include <string>
#include <vector>

#include "scene/scene.h"

namespace luxel {

// Unit direction of map coordinates in [0, 1]^2, with the environment's rotation applied, and back.
glm::vec3 environment_direction(const Environment& environment, glm::vec2 uv);
glm::vec2 environment_uv(const Environment& environment, glm::vec3 direction);

// Any decoded picture as a map: three channels, cubes made equirectangular, negative texels black; what is
// done to it is a warning that names `file`.
Image environment_map(const Image& picture, const std::string& file, std::vector<std::string>& warnings);

// Solid angle of any texel of row y.
float texel_solid_angle(const Environment& environment, int y);

struct EnvironmentSample {
    glm::vec3 direction; // unit, away from the scene
    glm::vec3 radiance;  // = evaluate(direction)
    float pdf;           // per solid angle
};

// Draws directions with a density proportional to luminance. Keeps a pointer to `environment`, which must
// outlive it unmoved. An empty or black environment cannot be sampled.
class EnvironmentSampler {
public:
    explicit EnvironmentSampler(const Environment& environment);

    bool empty() const { return power_ <= 0.0; }
    // Luminance of the environment integrated over the sphere.
    double power() const { return power_; }
    EnvironmentSample sample(glm::vec2 u) const; // u in [0, 1)^2; not for an empty sampler
    float pdf(glm::vec3 direction) const;        // 0 for an empty sampler

private:
    const Environment* environment_;
    std::vector<float> rows_;    // cumulative share of the power up to and with row y
    std::vector<float> columns_; // the same within each row
    double power_ = 0.0;
};

} // namespace luxel
