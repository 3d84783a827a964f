// SPDX-License-Identifier: MIT
#include "shared/octahedral.h"

#include <gtest/gtest.h>

#include "shared/random.h"
#include "shared/sampling.h"

namespace luxel::shared {
namespace {

// Each coordinate is off by half a step of 1/32767 at most, so z by a whole one, a point of the octahedron by
// sqrt(6) / 2 steps, and its distance from the center is 1/sqrt(3) at least.
TEST(Octahedral, ComesBackWithinAStep) {
    float worst = 0.0f;
    for (uint i = 0; i < 20000; ++i) {
        const vec3 n = sample_sphere({uniform_float(hash2(i, 1u)), uniform_float(hash2(i, 2u))});
        worst = std::max(worst, length(unpack_unit(pack_unit(n)) - n));
    }
    EXPECT_LT(worst, 2.1214f / 32767.0f);
}

TEST(Octahedral, AxesAreExact) {
    for (int axis = 0; axis < 3; ++axis)
        for (float sign : {1.0f, -1.0f}) {
            vec3 n(0.0f);
            n[axis] = sign;
            EXPECT_EQ(unpack_unit(pack_unit(n * 3.0f)), n);
        }
}

} // namespace
} // namespace luxel::shared
