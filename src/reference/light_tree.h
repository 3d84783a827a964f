// SPDX-License-Identifier: MIT
// Many emitters, drawn by what they would send to a point: a binary tree of bounds, normal cones and power
// [Conty2018].
#pragma once
#include <cstdint>
#include <vector>

#include "scene/scene.h"

namespace luxel {

// What is known of emitters without looking at them one by one. They emit by the cosine to their normals,
// which are within a cone.
struct EmitterBounds {
    Bounds box;
    glm::vec3 axis;   // unit
    float cos_spread; // of the cone's half angle
    float power;
    bool two_sided;
};

class LightTree {
public:
    LightTree() = default;
    explicit LightTree(const std::vector<EmitterBounds>& emitters);

    bool empty() const { return nodes_.empty(); }
    // Chance 0: none of them can send light to the point. normal: of a surface that reflects light from its
    // front; zero: light from everywhere counts alike.
    struct Choice {
        std::size_t emitter = 0;
        float chance = 0.0f;
    };
    Choice choose(glm::vec3 position, glm::vec3 normal, float u) const;
    float chance(std::size_t emitter, glm::vec3 position, glm::vec3 normal) const;

private:
    struct Node {
        EmitterBounds of;
        std::uint32_t second = 0; // the first child follows; 0: a leaf,
        std::uint32_t emitter = 0;
    };
    std::uint32_t build(const std::vector<EmitterBounds>& emitters, std::uint32_t* first, std::uint32_t* end,
                        std::uint64_t trail, int depth);
    // Chance of the first child.
    float first_share(const Node& node, std::size_t index, glm::vec3 position, glm::vec3 normal,
                      bool& dark) const;

    std::vector<Node> nodes_;
    std::vector<std::uint64_t> trails_; // by emitter: bit i is set where the way to it takes the second child
};

// Unoccluded light from the bounds' emitters to a point, up to a factor; 0 only where none can arrive.
float importance(const EmitterBounds& bounds, glm::vec3 position, glm::vec3 normal);

} // namespace luxel
