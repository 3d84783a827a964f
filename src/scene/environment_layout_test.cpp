// SPDX-License-Identifier: MIT
#include "scene/environment_layout.h"

#include <cmath>

#include <gtest/gtest.h>

#include "scene/environment.h"

namespace luxel {
namespace {

struct Case {
    MapLayout layout;
    int columns, rows;
    glm::ivec2 cells[6]; // of -z, +x, +z, -x, +y, -y
};
constexpr Case cases[] = {
    {MapLayout::cross_4x3, 4, 3, {{1, 1}, {2, 1}, {3, 1}, {0, 1}, {1, 0}, {1, 2}}},
    {MapLayout::cross_3x4, 3, 4, {{1, 1}, {2, 1}, {1, 3}, {0, 1}, {1, 0}, {1, 2}}},
    {MapLayout::strip_6x1, 6, 1, {{4, 0}, {0, 0}, {5, 0}, {1, 0}, {2, 0}, {3, 0}}},
    {MapLayout::strip_1x6, 1, 6, {{0, 4}, {0, 0}, {0, 5}, {0, 1}, {0, 2}, {0, 3}}},
};
constexpr glm::vec3 axes[] = {{0, 0, -1}, {1, 0, 0}, {0, 0, 1}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}};

Environment environment_of(const Image& picture) {
    std::vector<std::string> warnings;
    Environment e;
    e.radiance = environment_map(picture, "file", warnings);
    EXPECT_EQ(warnings.size(), 1u);
    return e;
}

glm::dvec3 integral(const Environment& e) {
    glm::dvec3 sum(0.0);
    for (int y = 0; y < e.radiance.height; ++y)
        for (int x = 0; x < e.radiance.width; ++x)
            sum += glm::dvec3(e.radiance.rgb(x, y)) * double(texel_solid_angle(e, y));
    return sum;
}

// Of a rectangle at distance 1 from its corner at (0, 0) to (x, y) [van Oosterom 1983, for two triangles].
double corner_angle(double x, double y) { return std::atan2(x * y, std::sqrt(1.0 + x * x + y * y)); }

} // namespace

// Each face has a color of its own, and a bright texel in a corner where its picture says where up and right
// are.
TEST(EnvironmentLayout, FacesLieWhereTheyShould) {
    constexpr int side = 16;
    for (const Case& c : cases) {
        Image picture(c.columns * side, c.rows * side, 3);
        for (int f = 0; f < 6; ++f)
            for (int y = 0; y < side; ++y)
                for (int x = 0; x < side; ++x) {
                    const bool turned = c.layout == MapLayout::cross_3x4 && f == 2;
                    // Grows to the right and, faster, downward as the face is seen.
                    const int right = turned ? side - 1 - x : x, down = turned ? side - 1 - y : y;
                    picture.set_rgb(c.cells[f].x * side + x, c.cells[f].y * side + y,
                                    {float(f + 1), float(right + 1), float(down + 1)});
                }
        ASSERT_EQ(layout_of(picture), c.layout);
        const Environment e = environment_of(picture);
        ASSERT_EQ(e.radiance.width, 4 * side);
        for (int f = 0; f < 6; ++f) {
            EXPECT_NEAR(evaluate(e, axes[f]).r, float(f + 1), 1e-3f);
            // Seen from within with up as it is, and for top and bottom as if the head were tilted from the
            // front.
            const glm::vec3 up = f == 4   ? glm::vec3(0, 0, 1)
                                 : f == 5 ? glm::vec3(0, 0, -1)
                                          : glm::vec3(0, 1, 0);
            const glm::vec3 right = glm::cross(axes[f], up);
            const glm::vec3 there = evaluate(e, glm::normalize(axes[f] + 0.5f * right - 0.25f * up));
            EXPECT_NEAR(there.g, 0.75f * side + 0.5f, 1.0f) << f << " of layout " << int(c.layout);
            EXPECT_NEAR(there.b, 0.625f * side + 0.5f, 1.0f) << f << " of layout " << int(c.layout);
        }
    }
}

TEST(EnvironmentLayout, ConversionKeepsTheLight) {
    constexpr int side = 16;
    for (const Case& c : cases)
        for (int f = 0; f < 6; ++f) {
            Image picture(c.columns * side, c.rows * side, 3);
            picture.set_rgb(c.cells[f].x * side + 3, c.cells[f].y * side + 8, glm::vec3(1000.0f));
            const double x0 = 10.0 / 16, x1 = 8.0 / 16, y = 2.0 / 16;
            const double expected = 1000.0 * (corner_angle(x0, y) - corner_angle(x1, y));
            EXPECT_NEAR(integral(environment_of(picture)).x, expected, 0.01 * expected) << f;
            // All alike: nothing but the sphere's area.
            for (float& v : picture.data) v = 0.5f;
            EXPECT_NEAR(integral(environment_of(picture)).x, 2.0 * 3.14159265, 1e-4);
        }
}

TEST(EnvironmentLayout, OtherShapesAreNamed) {
    Image noise(8, 6, 3);
    for (std::size_t i = 0; i < noise.data.size(); ++i) noise.data[i] = float(i * 37 % 11);
    EXPECT_EQ(layout_of(noise), MapLayout::other);
    EXPECT_EQ(layout_of(Image(8, 8, 3)), MapLayout::square);
    EXPECT_EQ(layout_of(Image(8, 4, 3)), MapLayout::equirectangular);
    std::vector<std::string> warnings;
    environment_map(noise, "a.exr", warnings);
    environment_map(Image(8, 8, 3), "b.exr", warnings);
    environment_map(Image(8, 4, 3), "c.exr", warnings);
    ASSERT_EQ(warnings.size(), 2u);
    EXPECT_NE(warnings[0].find("a.exr: the environment is not twice as wide as high (8x6)"),
              std::string::npos);
    EXPECT_NE(warnings[1].find("mirror ball"), std::string::npos);
}

} // namespace luxel
