// SPDX-License-Identifier: MIT
// Known values of ambient occlusion: an open plane, a wall's foot, the edge where they meet. Every technique
// of the occlusion slot joins by a line in `estimators`.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "support/analytic_frame.h"
#include "support/gpu.h"
#include "techniques/technique.h"

namespace luxel::testing {
namespace {

constexpr double pi = std::numbers::pi;

// Openness at the foot of an infinite wall, at distance a (in radii) before it: the double integral over
// directions (z toward the sky, x toward the wall), where an occluder at distance d leaves `open(d, cosine)`.
template <class Open> double before_wall(double a, const Open& open) {
    constexpr int n = 400;
    double sum = 0.0, weight = 0.0;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            double cosine = std::sqrt((i + 0.5) / n), phi = 2.0 * pi * (j + 0.5) / n; // density cos/pi
            double toward = std::sqrt(1.0 - cosine * cosine) * std::cos(phi);
            double d = toward > 0.0 ? a / toward : 1e30;
            sum += open(d, cosine), weight += open(1e30, cosine);
        }
    return sum / weight;
}

double step(double d, double) { return d < 1.0 ? 0.0 : 1.0; }
double cubic(double d, double) { return std::pow(std::min(d, 1.0), 3.0); }
double tangent(double d, double cosine) { return cosine * cosine * std::pow(std::min(d / cosine, 1.0), 3.0); }
double square_root(double d, double) { return std::sqrt(std::min(d, 1.0)); }
double exponential(double d, double) { return 1.0 - std::exp(-d); }

struct Estimator {
    const char* use; // without radius and samples
    double (*at_wall)(double a);
    double plane = 1.0;
    bool analytic = false; // divides by what the taps should find, not by what they find
    int samples = 64;
};
double step_wall(double a) { return before_wall(a, step); }
double sqrt_wall(double a) { return before_wall(a, square_root); }
double cubic_wall(double a) { return before_wall(a, cubic); }
double tangent_wall(double a) { return before_wall(a, tangent); }
double exponential_wall(double a) { return before_wall(a, exponential); }
// The tangent sphere (radius 1/2) less the cap beyond the wall.
double tangent_ball(double a) {
    double h = std::max(0.0, 1.0 - 2.0 * a); // height of the cap for a unit sphere
    return 1.0 - h * h * (3.0 - h) / 4.0;
}
// Half of the ball (the floor) less the cap that the wall cuts off, which the floor halves too.
double ball_wall(double a) { return 0.5 * (1.0 - 0.25 * (1.0 - a) * (1.0 - a) * (2.0 + a)); }

// Solid angle instead of projected solid angle, and a falloff of 1 - d^2, which leaves d^2 open.
double hbao_wall(double a) {
    return before_wall(a, [](double d, double cosine) { return std::pow(std::min(d, 1.0), 2.0) / cosine; });
}
double hbao_step_wall(double a) {
    return before_wall(a, [](double d, double cosine) { return d < 1.0 ? 0.0 : 1.0 / cosine; });
}

// Infinitely thick surfaces: the wall hides its back.
const Estimator estimators[] = {
    {"ssao:thickness=1000", ball_wall, 0.5},
    {"containment:thickness=1000", step_wall},
    {"containment:thickness=1000,membership=sqrt", sqrt_wall},
    {"containment:thickness=1000,membership=cubic", cubic_wall},
    {"containment:thickness=1000,membership=tangent", tangent_wall},
    {"containment:thickness=1000,membership=exponential", exponential_wall},
    {"volumetric:thickness=1000", tangent_wall},
    {"volumetric:thickness=1000,normalization=analytic", tangent_wall, 1.0, true},
    {"hbao:thickness=1000,falloff=quadratic", hbao_wall},
    {"hbao:thickness=1000", hbao_step_wall},
    {"gtao:thickness=1000", step_wall},
};

// N = 16 n samples (n in 16 turns), each of them in [0, 1]: their variance is at most that of a coin of the
// same mean. Half of the interval that contains the mean of independent ones at three standard deviations
// [Wilson1927], which does not close at means of 0 and 1. Ours are spread more evenly than independent ones.
double bound(double mean, int samples) {
    double count = 16.0 * samples, z2 = 9.0;
    return (3.0 * std::sqrt(mean * (1.0 - mean) / count + z2 / (4.0 * count * count)) + z2 / (2.0 * count)) /
           (1.0 + z2 / count);
}

Camera camera_at(glm::vec3 position, glm::vec3 target, float yfov = 0.7f) {
    Camera c;
    c.position = position, c.yfov = yfov;
    c.forward = glm::normalize(target - position);
    if (std::abs(c.forward.y) > 0.999f) c.up = {0, 0, -1};
    return c;
}

class OcclusionClosedForms : public GpuTest {
protected:
    Image accessibility(const AnalyticFrame& a, const std::string& use) {
        std::unique_ptr<Technique> technique = make_technique(parse_specification(use));
        EXPECT_EQ(technique->slot(), Slot::occlusion);
        gpu::Recorder recorder(gpu());
        Contribution c = technique->render(recorder, a.frame);
        recorder.submit();
        EXPECT_FALSE(c.radiance);
        EXPECT_EQ(c.accessibility.info().format, VK_FORMAT_R32_SFLOAT);
        return gpu().read(c.accessibility);
    }
    std::string use(const Estimator& e, double radius, const std::string& more = "") {
        return std::string(e.use) + ",radius=" + std::to_string(radius) +
               ",samples=" + std::to_string(e.samples) + more;
    }
};

// Angle between the view direction and the normal in the middle of the image; the edges differ from it by the
// half field of view.
AnalyticFrame tilted_plane(gpu::Gpu& gpu, double degrees, int size, float yfov = 0.7f) {
    float t = float(degrees * pi / 180.0);
    Camera camera = camera_at(10.0f * glm::vec3(0, std::cos(t), std::sin(t)), glm::vec3(0), yfov);
    return analytic_frame(gpu, camera, size, size, {{glm::vec3(0), {0, 1, 0}}});
}

TEST_F(OcclusionClosedForms, PlaneIsOpenAtEveryAngle) {
    for (double degrees : {0.0, 30.0, 60.0, 75.0, 85.0}) {
        AnalyticFrame a = tilted_plane(gpu(), degrees, 96);
        for (const Estimator& e : estimators) {
            if (e.plane != 1.0 || e.analytic) continue;
            for (const char* resolution : {",resolution=full", ",resolution=half"})
                for (float radius : {0.2f, 1.0f}) {
                    Image open = accessibility(a, use(e, radius, resolution));
                    for (float value : open.data)
                        ASSERT_NEAR(value, 1.0, 1e-3)
                            << e.use << resolution << " radius " << radius << " at " << degrees;
                }
        }
    }
}

// The sphere's volume is known only up to the spread of n chords (mean 2/3, mean square 1/2 of the radius: a
// relative deviation of sqrt(1/8)). The sphere is 13 pixels wide; where it covers few pixels their places
// lose more.
TEST_F(OcclusionClosedForms, PlaneIsOpenOnAverageWithAnalyticNormalization) {
    AnalyticFrame a = tilted_plane(gpu(), 30.0, 96);
    for (const Estimator& e : estimators) {
        if (!e.analytic) continue;
        double sum = 0.0;
        Image open = accessibility(a, use(e, 1.0));
        for (float value : open.data) sum += value;
        EXPECT_NEAR(sum / double(open.data.size()), 1.0, 3.0 * std::sqrt(0.125 / e.samples)) << e.use;
    }
}

// Below a plane half of the ball is hidden; with surfaces of finite thickness T (in radii, along the view
// ray) only the slab down to c = min(1, T cos): (3 c - c^3) / 4 of the ball.
TEST_F(OcclusionClosedForms, SsaoIsGrayOnPlanes) {
    for (double degrees : {0.0, 30.0, 60.0, 75.0, 85.0}) {
        AnalyticFrame a = tilted_plane(gpu(), degrees, 192, 0.15f);
        for (double thickness : {1.0, 1000.0}) {
            double c = std::min(1.0, thickness * std::cos(degrees * pi / 180.0));
            double expected = 1.0 - (3.0 * c - c * c * c) / 4.0;
            Image open =
                accessibility(a, "ssao:radius=0.3,samples=64,thickness=" + std::to_string(thickness));
            double sum = 0.0, count = 0.0;
            for (int y = 92; y < 100; ++y)
                for (int x = 92; x < 100; ++x) sum += *open.at(x, y), ++count;
            EXPECT_NEAR(sum / count, expected, bound(expected, 64))
                << degrees << " degrees, thickness " << thickness;
        }
    }
}

// Floor y = 0 and wall x = 0 (free side x < 0), both seen at 45 degrees; meters are radii.
AnalyticFrame wall_and_floor(gpu::Gpu& gpu, int size, float distance = 6.0f) {
    return analytic_frame(gpu, camera_at({-distance, distance, 0}, {-0.2f, 0.2f, 0}, 2.8f / distance), size,
                          size, {{glm::vec3(0), {0, 1, 0}}, {glm::vec3(0), {-1, 0, 0}}});
}

// Mean of the pixels of the floor at distance a +- half a pixel's footprint from the wall, in the middle
// third.
double mean_at(const AnalyticFrame& f, const Image& open, double a, double half_width) {
    double sum = 0.0, count = 0.0;
    for (int y = 0; y < open.height; ++y)
        for (int x = open.width / 3; x < open.width * 2 / 3; ++x) {
            std::size_t i = f.index(x, y);
            if (f.plane[i] != 0 || std::abs(-double(f.position[i].x) - a) > half_width) continue;
            sum += *open.at(x, y), ++count;
        }
    EXPECT_GT(count, 32.0) << "a = " << a;
    return sum / count;
}

TEST_F(OcclusionClosedForms, QuadratureHasTheKnownValues) {
    const double a[] = {0.1, 0.25, 0.5}, v[] = {0.648, 0.844, 1.0}, o3[] = {0.594, 0.724, 0.890},
                 o1[] = {0.563, 0.656, 0.805};
    for (int i = 0; i < 3; ++i) {
        EXPECT_NEAR(tangent_wall(a[i]), v[i], 2e-3);
        EXPECT_NEAR(tangent_wall(a[i]), tangent_ball(a[i]), 5e-4);
        EXPECT_NEAR(cubic_wall(a[i]), o3[i], 2e-3);
        EXPECT_NEAR(step_wall(a[i]), o1[i], 2e-3);
        // The part of the unit disc beyond the chord at a.
        EXPECT_NEAR(step_wall(a[i]), 1.0 - (std::acos(a[i]) - a[i] * std::sqrt(1.0 - a[i] * a[i])) / pi,
                    5e-4);
    }
}

TEST_F(OcclusionClosedForms, WallsFoot) {
    constexpr int size = 192; // a pixel sees about .02 radii of the floor
    AnalyticFrame f = wall_and_floor(gpu(), size);
    for (const Estimator& e : estimators) {
        Image open = accessibility(f, use(e, 1.0));
        for (double a : {0.1, 0.25, 0.5}) {
            double expected = e.at_wall(a);
            EXPECT_NEAR(mean_at(f, open, a, 0.015), expected, bound(expected, e.samples))
                << e.use << " at " << a;
        }
    }
}

// The edge itself, approached to three pixels: half of the hemisphere, a quarter of the ball. The filter's
// window of four pixels is off center by half a pixel, .01 radii, and no value rises by more than 2 per
// radius.
TEST_F(OcclusionClosedForms, RightAngle) {
    AnalyticFrame f = wall_and_floor(gpu(), 192);
    for (const Estimator& e : estimators) {
        Image open = accessibility(f, use(e, 1.0));
        double expected = e.at_wall(0.03);
        EXPECT_NEAR(mean_at(f, open, 0.03, 0.02), expected, bound(expected, e.samples) + 0.02) << e.use;
    }
}

// Both normalizations see the same taps; dividing by what they find of the sphere removes what they miss of
// it.
TEST_F(OcclusionClosedForms, WeightedImportanceSamplingBeatsAnalyticNormalizationAtFourSamples) {
    AnalyticFrame f = wall_and_floor(gpu(), 128);
    for (const char* pattern : {"none", "interleaved"}) {
        double error[2] = {};
        for (int i = 0; i < 2; ++i) {
            const char* normalization = i == 0 ? "wis" : "analytic";
            Image open =
                accessibility(f, std::string("volumetric:samples=4,radius=1,thickness=1000,pattern=") +
                                     pattern + ",normalization=" + normalization);
            for (int y = 0; y < open.height; ++y)
                for (int x = open.width / 3; x < open.width * 2 / 3; ++x) {
                    std::size_t at = f.index(x, y);
                    double a = -double(f.position[at].x);
                    if (f.plane[at] != 0 || a > 1.0) continue;
                    error[i] += std::abs(double(*open.at(x, y)) - tangent_ball(a));
                }
        }
        EXPECT_LT(error[0], error[1]) << pattern;
    }
}

} // namespace
} // namespace luxel::testing
