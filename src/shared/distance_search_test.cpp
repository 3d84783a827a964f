// SPDX-License-Identifier: MIT
// Searches in distance maps against exact rays in a box, and what must not be hit.
#include "shared/distance_search.h"

#include <algorithm>
#include <functional>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "shared/cube.h"

namespace luxel::shared {

namespace {
std::function<float(vec3)> surface; // what the tests search
std::function<bool(vec3, vec3)> counts;
std::function<vec3(vec3)> normal = [](vec3 d) { return d; };
} // namespace
float surface_distance(vec3 direction, int) { return surface(normalize(direction)); }
bool surface_counts(vec3 p, vec3 r, int) { return !counts || counts(p, r); }
vec3 surface_normal(vec3 direction, int) { return normal(normalize(direction)); }

namespace {

constexpr float half = 1.0f; // of the box around the center

// Distance of the walls of [-1, 1]^3 from o.
float box_distance(vec3 o, vec3 d) {
    float t = 1e30f;
    for (int i = 0; i < 3; ++i) t = std::min(t, ((d[i] > 0 ? half : -half) - o[i]) / d[i]);
    return t;
}

// The same as a cube map of `size` texels a side holds it, with the filter of the sampler.
struct SampledBox {
    int size;
    std::vector<float> texels;
    explicit SampledBox(int n) : size(n), texels(std::size_t(6 * n * n)) {
        for (int face = 0; face < 6; ++face)
            for (int y = 0; y < n; ++y)
                for (int x = 0; x < n; ++x)
                    texels[std::size_t((face * n + y) * n + x)] = box_distance(
                        vec3(0), normalize(cube_direction(face, (vec2(x, y) + 0.5f) / float(n))));
    }
    float operator()(vec3 direction) const {
        const CubePlace place = cube_place(direction);
        const vec2 at = clamp(place.uv * float(size) - 0.5f, vec2(0), vec2(float(size - 1)));
        const int x = std::min(int(at.x), size - 2), y = std::min(int(at.y), size - 2);
        const float u = at.x - float(x), v = at.y - float(y);
        auto texel = [&](int i, int j) { return texels[std::size_t((place.face * size + j) * size + i)]; };
        return mix(mix(texel(x, y), texel(x + 1, y), u), mix(texel(x, y + 1), texel(x + 1, y + 1), u), v);
    }
};

// Rays off a mirror sphere of radius .4 around the center, away from where the box's edges would be hit.
struct TestRay {
    vec3 x, r, hit;
};
std::vector<TestRay> sphere_rays(int count) {
    std::mt19937 random(5);
    std::normal_distribution<float> gauss;
    std::vector<TestRay> rays;
    while (int(rays.size()) < count) {
        const vec3 n = normalize(vec3(gauss(random), gauss(random), gauss(random)));
        const vec3 eye = normalize(vec3(gauss(random), gauss(random), gauss(random)));
        if (dot(eye, n) > -0.1f) continue;
        const vec3 x = n * 0.4f, r = reflect(eye, n), hit = x + r * box_distance(x, r);
        const vec3 m = abs(hit);
        const float middle = m.x + m.y + m.z - std::max({m.x, m.y, m.z}) - std::min({m.x, m.y, m.z});
        if (middle < 0.95f * half) rays.push_back({x, r, hit});
    }
    return rays;
}

// 95th percentile of the distance between a ray's hit and where the search puts it, m.
float error95(const std::vector<TestRay>& rays, int kind, int linear, int refine) {
    std::vector<float> errors;
    const DistanceSearch s{.linear = linear, .refine = refine, .jump = 10.0f, .texel = 2.0f / 512.0f};
    for (const TestRay& ray : rays) {
        const RayHit hit = search_layer(ray.x, ray.r, range_between(ray.x, ray.r, 0.99f, 2.0f), 0, kind, s);
        // What is shown is the surface in the direction of the hit.
        const vec3 p = ray.x + ray.r * hit.d;
        errors.push_back(hit.layer < 0 ? 1e30f : length(normalize(p) * surface(normalize(p)) - ray.hit));
    }
    std::nth_element(errors.begin(), errors.begin() + std::ptrdiff_t(errors.size() * 95 / 100), errors.end());
    return errors[errors.size() * 95 / 100];
}

TEST(DistanceSearch, MirrorSphereInABoxIsExactToATexelWithSecantSteps) {
    surface = SampledBox(512), counts = nullptr;
    const std::vector<TestRay> rays = sphere_rays(2000);
    EXPECT_LT(error95(rays, REFINE_SECANT, 32, 8), 2.0f * half / 512.0f);

    // |p|/|p'| is linear along a ray toward a plane: the first step is exact.
    EXPECT_LT(error95(rays, REFINE_SECANT, 15, 1), 1e-5f);
    EXPECT_LT(error95(rays, REFINE_NONE, 80, 0), 0.5f * error95(rays, REFINE_NONE, 15, 0));
}

// Fig. 5.5 on a curved wall: both kinds of steps help, and a secant step more than one of bisection.
TEST(DistanceSearch, ErrorFallsWithLinearAndWithSecantSteps) {
    const vec3 inverse_axes(1.0f, 0.6f, 0.85f);
    surface = [&](vec3 d) { return 1.0f / length(d * inverse_axes); };
    counts = nullptr;
    std::vector<TestRay> rays = sphere_rays(1000);
    for (TestRay& ray : rays) {
        const vec3 x = ray.x * inverse_axes, r = ray.r * inverse_axes;
        const float b = dot(x, r), c = dot(x, x) - 1.0f, a = dot(r, r);
        ray.hit = ray.x + ray.r * ((std::sqrt(b * b - a * c) - b) / a);
    }
    auto error = [&](int kind, int linear, int refine) { return error95(rays, kind, linear, refine); };
    EXPECT_LT(error(REFINE_NONE, 80, 0), 0.5f * error(REFINE_NONE, 15, 0));
    EXPECT_LT(error(REFINE_SECANT, 15, 1), 0.2f * error(REFINE_NONE, 15, 0));
    EXPECT_LT(error(REFINE_SECANT, 15, 10), 0.2f * error(REFINE_SECANT, 15, 1));
    EXPECT_LT(error(REFINE_SECANT, 80, 1), 0.2f * error(REFINE_SECANT, 15, 1));
    EXPECT_LT(error(REFINE_SECANT, 15, 2), 0.2f * error(REFINE_BINARY, 15, 2));
    EXPECT_LT(error(REFINE_BINARY, 15, 10), 0.1f * error(REFINE_BINARY, 15, 2));
}

TEST(DistanceSearch, ParallaxStepsComeCloser) {
    surface = [](vec3 d) { return box_distance(vec3(0), d); };
    float error[4] = {};
    const std::vector<TestRay> rays = sphere_rays(500);
    for (int steps : {0, 1, 3})
        for (const TestRay& ray : rays)
            error[steps] += length(parallax_guess(ray.x, ray.r, 0, steps) - ray.hit) / float(rays.size());
    EXPECT_GT(error[0], 0.1f);
    EXPECT_LT(error[1], 0.6f * error[0]);
    EXPECT_LT(error[3], 0.7f * error[1]);

    // Across the ray the surface is what the step takes it to be.
    const vec3 x(0.0f, 0.0f, 0.3f), r(1, 0, 0);
    surface = [](vec3 d) { return 1.0f / std::max(d.x, 1e-6f); };
    EXPECT_NEAR(length(parallax_guess(x, vec3(1, 0, 0), 0, 1) - (x + r)), 0.0f, 1e-5f);
}

TEST(DistanceSearch, RangeIsCutBySpheres) {
    RayRange range = range_between(vec3(0, 0, 0), vec3(1, 0, 0), 0.5f, 2.0f);
    EXPECT_FLOAT_EQ(range.first, 0.5f);
    EXPECT_FLOAT_EQ(range.last, 2.0f);
    range = range_between(vec3(-5, 1, 0), vec3(1, 0, 0), 0.5f, 2.0f);
    EXPECT_NEAR(range.first, 5.0f - std::sqrt(3.0f), 1e-5f);
    EXPECT_NEAR(range.last, 5.0f + std::sqrt(3.0f), 1e-5f);
    range = range_between(vec3(-5, 3, 0), vec3(1, 0, 0), 0.5f, 2.0f);
    EXPECT_LT(range.last, range.first);
    range = range_between(vec3(3, 0, 0), vec3(1, 0, 0), 0.5f, 2.0f);
    EXPECT_LE(range.last, range.first);
}

// A disc before a wall, as one layer: the step between both is no surface, though filtering makes it one.
TEST(DistanceSearch, GapsAreNoWalls) {
    counts = nullptr;
    surface = [](vec3 d) {
        const float angle = std::acos(std::clamp(d.z, -1.0f, 1.0f));
        const float share = std::clamp((angle - 0.2f) / 0.004f + 0.5f, 0.0f, 1.0f);
        return mix(1.0f, 4.0f, share);
    };
    const DistanceSearch s{.linear = 64, .refine = 8, .jump = 0.2f, .texel = 0.004f};
    const vec3 x(-2, 0, 2), r(1, 0, 0);
    const RayHit hit = search_layer(x, r, range_between(x, r, 0.0f, 5.0f), 0, REFINE_SECANT, s);
    ASSERT_EQ(hit.layer, 0);
    EXPECT_NEAR(length(x + r * hit.d), 4.0f, 0.01f);
}

// A ray that starts on a sphere and leaves it does not hit it where it starts; one inside meets the far side.
TEST(DistanceSearch, FacingDecidesWhatCounts) {
    surface = [](vec3) { return 1.0f; };
    counts = [](vec3 p, vec3 r) { return dot(p, r) < 0.0f; };
    const DistanceSearch s{.linear = 32, .refine = 8, .jump = 0.2f, .texel = 0.004f};
    const vec3 x = normalize(vec3(0.3f, 1.0f, 0.2f)) * 0.9999f;
    const vec3 out = normalize(x + vec3(0.5f, 0.0f, 0.0f)), in = normalize(vec3(0.3f, 0.0f, 0.1f) - x);
    const RayRange leaving = range_between(x, out, 0.0f, 1.5f), entering = range_between(x, in, 0.0f, 1.5f);
    EXPECT_EQ(search_layer(x, out, leaving, 0, REFINE_SECANT, s).layer, -1);
    counts = [](vec3 p, vec3 r) { return dot(p, r) > 0.0f; };
    const RayHit hit = search_layer(x, in, entering, 0, REFINE_SECANT, s);
    ASSERT_EQ(hit.layer, 0);
    EXPECT_NEAR(hit.d, -2.0f * dot(x, in), 1e-3f);
}

// A floor that the center sees at a grazing angle: its distance doubles over two texels.
TEST(DistanceSearch, AGrazingPlaneIsNoGap) {
    constexpr float depth = 0.1f;
    surface = [](vec3 d) { return d.y < 0.0f ? depth / -d.y : 1e3f; };
    normal = [](vec3) { return vec3(0, 1, 0); };
    counts = nullptr;
    const DistanceSearch s{.linear = 64, .refine = 8, .jump = 0.3f, .texel = 2.0f / 128.0f};
    for (float far : {0.5f, 1.0f, 2.0f, 3.0f}) {
        const vec3 x(0.0f, 0.3f, 0.1f), r = normalize(vec3(far, -depth, 0.3f) - x);
        const RayHit hit = search_layer(x, r, range_between(x, r, depth, 4.0f), 0, REFINE_SECANT, s);
        ASSERT_EQ(hit.layer, 0) << far;
        EXPECT_NEAR((x + r * hit.d).y, -depth, 1e-4f) << far;
    }
    normal = [](vec3 d) { return d; };
}

// A plate before a wall, both facing the center: the filter fills the texel between them, which is no surface
// of either.
TEST(DistanceSearch, AGapBesideAPlateIsNoPlane) {
    constexpr float edge = 0.2f, texel = 2.0f / 128.0f;
    surface = [](vec3 d) {
        const float share = clamp((d.y - edge) / texel, 0.0f, 1.0f);
        return (1.0f + 2.0f * share) / std::max(d.x, 0.1f);
    };
    normal = [](vec3) { return vec3(-1, 0, 0); };
    counts = nullptr;
    const DistanceSearch s{.linear = 64, .refine = 8, .jump = 0.3f, .texel = texel};
    const vec3 x(2.0f, -0.5f, 0.0f), r(0, 1, 0); // behind the plate, past its edge
    const RayHit hit = search_layer(x, r, range_between(x, r, 0.9f, 3.5f), 0, REFINE_SECANT, s);
    EXPECT_EQ(hit.layer, -1);
    normal = [](vec3 d) { return d; };
}

} // namespace
} // namespace luxel::shared
