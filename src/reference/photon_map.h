// SPDX-License-Identifier: MIT
// Photons in a balanced k-d tree without pointers: the middle of a range splits it.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

namespace luxel {

struct Photon {
    glm::vec3 position;
    glm::vec3 normal;    // unit geometric normal, on the side that the light came from
    glm::vec3 direction; // unit, where the light came from
    glm::vec3 power;     // W
};

class PhotonMap {
public:
    // The same tree for the same photons in the same order.
    explicit PhotonMap(std::vector<Photon> photons);

    std::size_t size() const { return photons_.size(); }

    // visit(photon, squared distance) for all within `radius` of p, always in the same order.
    template <class Visit> void within(glm::vec3 p, float radius, Visit&& visit) const {
        struct Part {
            std::uint32_t first, end;
        };
        std::array<Part, 64> stack; // ranges halve: no more than one waits at each of 32 levels
        std::size_t waiting = 0;
        stack[waiting++] = {0, std::uint32_t(photons_.size())};
        const auto look_at = [&](const Photon& photon) {
            const glm::vec3 d = photon.position - p;
            const float d2 = glm::dot(d, d);
            if (d2 <= radius * radius) visit(photon, d2);
        };
        while (waiting > 0) {
            const Part range = stack[--waiting];
            if (range.end - range.first <= leaf_size) {
                for (std::uint32_t i = range.first; i < range.end; ++i) look_at(photons_[i]);
                continue;
            }
            const std::uint32_t middle = range.first + (range.end - range.first) / 2;
            const Photon& split = photons_[middle];
            look_at(split);
            const float side = p[axis_[middle]] - split.position[axis_[middle]];
            if (side >= -radius) stack[waiting++] = {middle + 1, range.end};
            if (side <= radius) stack[waiting++] = {range.first, middle};
        }
    }

private:
    void build(std::uint32_t first, std::uint32_t end);

    static constexpr std::uint32_t leaf_size = 8;
    std::vector<Photon> photons_;
    std::vector<std::uint8_t> axis_; // that the photon at this place splits along
};

} // namespace luxel
