// SPDX-License-Identifier: MIT
// Texture lookups in two steps: where, then what.
#pragma once
#include "scene/scene.h"

namespace luxel {

// Texel indices on one axis and the weight of the second, as Vulkan's linear filter defines them.
struct Taps {
    int first, second;
    float weight;
};

// The texels that a lookup will read. Finding them is apart from reading them, so that they can be fetched
// early.
struct Footprint {
    const Texture* texture = nullptr;
    Taps x, y; // unset without a texture
};

Footprint footprint(const Texture& texture, glm::vec2 uv);
void prefetch(const Footprint& footprint);    // also without
glm::vec4 filter(const Footprint& footprint); // with a texture: as sample_texture()
// One texel, decoded as filter() decodes it.
glm::vec4 texel(const Texture& texture, int x, int y);

} // namespace luxel
