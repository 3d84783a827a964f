// SPDX-License-Identifier: MIT
#include "reference/photon_map.h"

#include <algorithm>

#include <tbb/parallel_invoke.h>

namespace luxel {

namespace {
constexpr std::uint32_t worth_a_task = 1 << 14;
}

PhotonMap::PhotonMap(std::vector<Photon> photons) : photons_(std::move(photons)), axis_(photons_.size()) {
    build(0, std::uint32_t(photons_.size()));
}

void PhotonMap::build(std::uint32_t first, std::uint32_t end) {
    if (end - first <= leaf_size) return;
    glm::vec3 least(photons_[first].position), most(least);
    for (std::uint32_t i = first; i < end; ++i)
        least = glm::min(least, photons_[i].position), most = glm::max(most, photons_[i].position);
    const glm::vec3 extent = most - least;
    const int axis = extent.x >= extent.y ? (extent.x >= extent.z ? 0 : 2) : (extent.y >= extent.z ? 1 : 2);

    const std::uint32_t middle = first + (end - first) / 2;
    std::nth_element(
        photons_.begin() + first, photons_.begin() + middle, photons_.begin() + end,
        [axis](const Photon& a, const Photon& b) { return a.position[axis] < b.position[axis]; });
    axis_[middle] = std::uint8_t(axis);
    if (end - first < worth_a_task) {
        build(first, middle);
        build(middle + 1, end);
        return;
    }
    tbb::parallel_invoke([=, this] { build(first, middle); }, [=, this] { build(middle + 1, end); });
}

} // namespace luxel
