// SPDX-License-Identifier: MIT
// Directions of cube texels, there and back.
#include "shared/cube.h"

#include <random>

#include <gtest/gtest.h>

namespace luxel {
namespace {

using glm::vec2;
using glm::vec3;

TEST(Cube, FacesLookAlongTheirAxes) {
    const vec3 axes[6] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    for (int face = 0; face < 6; ++face) {
        EXPECT_EQ(shared::cube_direction(face, vec2(0.5f)), axes[face]);
        shared::CubeAxes a = shared::cube_axes(face);
        EXPECT_EQ(glm::cross(a.u, a.v), -a.forward);
    }
    // By the tables of the Vulkan specification: (+x, u = 1) toward -z, (+y, v = 1) toward +z, (-z, u = 1)
    // -x.
    EXPECT_EQ(shared::cube_direction(0, {1.0f, 0.5f}), vec3(1, 0, -1));
    EXPECT_EQ(shared::cube_direction(2, {0.5f, 1.0f}), vec3(0, 1, 1));
    EXPECT_EQ(shared::cube_direction(5, {1.0f, 0.5f}), vec3(-1, 0, -1));
}

TEST(Cube, PlaceIsTheInverseOfDirection) {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> unit(0.001f, 0.999f);
    for (int i = 0; i < 1000; ++i) {
        int face = i % 6;
        vec2 uv{unit(random), unit(random)};
        shared::CubePlace p = shared::cube_place(shared::cube_direction(face, uv) * (0.1f + 10.0f * uv.x));
        ASSERT_EQ(p.face, face);
        EXPECT_NEAR(p.uv.x, uv.x, 1e-6f);
        EXPECT_NEAR(p.uv.y, uv.y, 1e-6f);
    }
}

TEST(Cube, SolidAnglesCoverTheSphere) {
    for (int size : {1, 2, 8}) {
        float sum = 0.0f;
        for (int j = 0; j < size; ++j)
            for (int i = 0; i < size; ++i) sum += shared::cube_texel_solid_angle(i, j, size);
        EXPECT_NEAR(sum, 4.0f * shared::PI / 6.0f, 1e-5f);
    }
    // Small texels: area over r^3.
    EXPECT_NEAR(shared::cube_texel_solid_angle(32, 32, 64) * 1024.0f, 1.0f, 1e-2f);
}

} // namespace
} // namespace luxel
