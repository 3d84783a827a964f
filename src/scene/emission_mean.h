// SPDX-License-Identifier: MIT
// What textured and masked emitters send in the mean, without sampling: a lamp of a few texels is not missed.
#pragma once
#include <array>
#include <cstdint>
#include <map>
#include <utility>

#include "scene/scene.h"
#include "scene/texel_patches.h"

namespace luxel {

// Keeps a tree over the texels of each texture that emitters use. `scene` must outlive it.
class EmissionMeans {
public:
    explicit EmissionMeans(const Scene& scene) : scene_(&scene) {}

    // Mean radiance of a triangle's front, the bilinear filter's values as emission_at() reads them; holes of
    // an alpha mask send nothing, blended surfaces their share. Exact, except that an outline of a mask is
    // made of straight pieces, eight and more in each texel that it crosses.
    glm::vec3 mean(std::uint32_t instance, std::uint32_t triangle);

private:
    const TexelPatches& patches(int texture, float cutoff);

    const Scene* scene_;
    std::map<std::pair<int, float>, TexelPatches> patches_;
};

} // namespace luxel
