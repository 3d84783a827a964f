// SPDX-License-Identifier: MIT
// The solids that a path is inside of, and what they absorb.
#pragma once
#include <array>
#include <cstddef>

#include "scene/surface.h"

namespace luxel {

// What is left of white light after `distance` meters inside the material [Beer's law].
glm::vec3 attenuation(const Material& material, float distance);

class Media {
public:
    bool empty() const { return count_ == 0; }
    // The path leaves `surface` along `direction`; where it went through a solid's interface, it has entered
    // or left that solid.
    void leave(const Surface& surface, glm::vec3 direction);
    // What is left of light after so far. `met`: what is at the end; whose back is met without having been
    // entered was around the path from the beginning.
    glm::vec3 transmittance(float distance, const Surface* met = nullptr) const;

private:
    std::array<const Material*, 8> inside_{}; // innermost last; of more the outermost are forgotten
    std::size_t count_ = 0;
};

} // namespace luxel
