// SPDX-License-Identifier: MIT
// Poisson-disk sets: far apart, uniform, the same every time.
#include "techniques/common/point_sets.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace luxel {
namespace {

double least_distance(const std::vector<glm::vec3>& points) {
    double least = 1e30;
    for (std::size_t i = 0; i < points.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            least = std::min(least, double(glm::distance(points[i], points[j])));
    return least;
}

// Half of the greatest possible distance of n points in the disc (densest packing) is what white noise almost
// never reaches; dart throwing ends near .65.
TEST(PointSets, DiscPointsKeepTheirDistance) {
    for (int n : {4, 8, 16, 32, 64}) {
        std::vector<glm::vec3> points = poisson_disc(n);
        ASSERT_EQ(points.size(), std::size_t(n));
        double densest = 2.0 * std::sqrt(std::numbers::pi / (2.0 * std::sqrt(3.0) * n));
        EXPECT_GT(least_distance(points), 0.5 * densest) << n;
    }
}

TEST(PointSets, RadiiHaveAUniformDensity) {
    // The k-th of n radii squared is (k + 1/2)/n in the disc and the cylinder, cubed in the ball.
    for (int n : {1, 5, 16, 64}) {
        for (int domain = 0; domain < 3; ++domain) {
            std::vector<glm::vec3> points = domain == 0   ? poisson_disc(n)
                                            : domain == 1 ? poisson_cylinder(n)
                                                          : poisson_ball(n);
            std::vector<double> shares;
            for (glm::vec3 p : points)
                shares.push_back(domain == 2 ? std::pow(double(glm::length(p)), 3.0)
                                             : double(p.x) * double(p.x) + double(p.y) * double(p.y));
            std::sort(shares.begin(), shares.end());
            for (int k = 0; k < n; ++k) EXPECT_NEAR(shares[std::size_t(k)], (k + 0.5) / n, 1e-5);
        }
    }
}

TEST(PointSets, AreBalancedAndRepeatable) {
    for (int n : {8, 32}) {
        // Mean of independent points: 0 with a deviation of 1/2 (disc) or sqrt(1/5) (ball) over sqrt n.
        glm::vec3 disc(0.0f), ball(0.0f);
        for (glm::vec3 p : poisson_disc(n)) disc += p / float(n);
        for (glm::vec3 p : poisson_ball(n)) ball += p / float(n);
        EXPECT_LT(glm::length(disc), 0.5 / std::sqrt(n)) << n;
        EXPECT_LT(glm::length(ball), std::sqrt(0.2 / n)) << n;
        EXPECT_EQ(poisson_ball(n), poisson_ball(n));
    }
}

} // namespace
} // namespace luxel
