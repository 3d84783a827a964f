// SPDX-License-Identifier: MIT
#include "reference/photon_map.h"

#include <gtest/gtest.h>

#include "shared/random.h"

namespace luxel {
namespace {

float uniform(shared::uint a, shared::uint b) { return shared::uniform_float(shared::hash2(a, b)); }

// Photons on a floor and in a cloud, some of them at the same place.
std::vector<Photon> some_photons(shared::uint count) {
    std::vector<Photon> photons;
    for (shared::uint i = 0; i < count; ++i) {
        const bool flat = i % 2 == 0;
        const glm::vec3 p(uniform(i, 0), flat ? 0.0f : uniform(i, 1), uniform(i % 700, 2));
        photons.push_back({p, {0, 1, 0}, glm::vec3(float(i))});
    }
    return photons;
}

TEST(PhotonMap, FindsWhatLiesWithin) {
    for (shared::uint count : {0u, 1u, 9u, 5000u, 40000u}) {
        const std::vector<Photon> photons = some_photons(count);
        const PhotonMap map(photons);
        ASSERT_EQ(map.size(), count);
        for (shared::uint q = 0; q < 20; ++q) {
            const glm::vec3 p(uniform(q, 7), 0.3f * uniform(q, 8), uniform(q, 9));
            const float radius = 0.2f * uniform(q, 10);
            double expected = 0.0, found = 0.0;
            for (const Photon& photon : photons) {
                const glm::vec3 d = photon.position - p;
                if (glm::dot(d, d) <= radius * radius) expected += double(photon.power.x) + 1.0;
            }
            map.within(p, radius, [&](const Photon& photon, float d2) {
                found += double(photon.power.x) + 1.0;
                EXPECT_LE(d2, radius * radius);
            });
            EXPECT_EQ(found, expected);
        }
    }
}

} // namespace
} // namespace luxel
