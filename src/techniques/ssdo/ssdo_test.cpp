// SPDX-License-Identifier: MIT
// Screen-space directional occlusion on analytic G-buffers: closed forms and invariants. The bound against
// the reference is in tests/.
#include <cmath>
#include <numbers>

#include "shared/sampling.h"
#include "support/gpu.h"
#include "support/traced_frame.h"
#include "techniques/ssdo/ssdo_params.h"

namespace luxel {
namespace {

using testing::TracedFrame;
using testing::TracedResult;
using testing::TracedSurface;
using testing::TracedView;
class Ssdo : public testing::GpuTest {};

const std::string exact = "ssdo:samples=64,steps=24,blur=0,resolution=full,thickness=0,radius=";

// Floor y = 0 of albedo 1 that ends at a wall z = -2 of radiance 1 and no albedo.
constexpr float wall_z = -2.0f;
TracedSurface floor_and_wall(glm::vec3 o, glm::vec3 ray) {
    float to_floor = ray.y < 0 ? -o.y / ray.y : 1e30f, to_wall = wall_z / ray.z;
    if (to_floor < to_wall) return {to_floor, {0, 1, 0}, glm::vec3(1), glm::vec3(0)};
    return {to_wall, {0, 0, 1}, glm::vec3(0), glm::vec3(1)};
}

// Three planes of a box around the camera, all of radiance and albedo as given.
auto box_of(glm::vec3 albedo, glm::vec3 radiance) {
    return [=](glm::vec3 o, glm::vec3 ray) {
        TracedSurface nearest{1e30f, {}, albedo, radiance};
        const glm::vec3 least(-1, 0, -2), most(1, 2, 2);
        for (int axis = 0; axis < 3; ++axis) {
            if (ray[axis] == 0.0f) continue;
            float t = ((ray[axis] > 0 ? most : least)[axis] - o[axis]) / ray[axis];
            if (t >= nearest.t) continue;
            nearest.t = t, nearest.normal = glm::vec3(0);
            nearest.normal[axis] = ray[axis] > 0 ? -1.0f : 1.0f;
        }
        return nearest;
    };
}

double mean_over_block(const Image& image, int x0, int y0, int size) {
    double sum = 0;
    for (int y = y0; y < y0 + size; ++y)
        for (int x = x0; x < x0 + size; ++x) sum += double(image.at(x, y)[0]);
    return sum / (size * size);
}

// Integral over the hemisphere around +y of cos/pi times f(direction).
template <class F> double cosine_mean(F&& f) {
    constexpr int n = 200;
    double sum = 0;
    for (int i = 0; i < n * n; ++i) {
        glm::vec2 u((float(i % n) + 0.5f) / n, (float(i / n) + 0.5f) / n);
        glm::vec3 d = shared::sample_cosine_hemisphere(u);
        sum += f(glm::vec3(d.x, d.z, d.y));
    }
    return sum / (n * n);
}

// Does a ray from the floor meet the part of the wall that the image shows, within the radius?
bool meets_wall(glm::vec3 from, glm::vec3 d, float radius) {
    float t = (wall_z - from.z) / d.z;
    glm::vec3 at = from + t * d;
    return d.z < 0 && t < radius && std::abs(at.x) < 2 && at.y < 3;
}

TEST_F(Ssdo, FloorBeforeALitWallReceivesItsFormFactor) {
    constexpr int size = 128;
    TracedFrame f(gpu(), {size, size}, floor_and_wall);
    TracedResult r = f.run(exact + "100");
    for (int y : {98, 108, 118}) {
        glm::vec3 ray = f.ray(size / 2, y + 2), at = glm::vec3(0, 1, 0) - ray / ray.y;
        double expected = cosine_mean([&](glm::vec3 d) { return meets_wall(at, d, 100.0f); });
        EXPECT_NEAR(mean_over_block(r.radiance, size / 2 - 2, y, 4) / expected, 1.0, 0.03) << at.z;
        EXPECT_NEAR(mean_over_block(r.accessibility, size / 2 - 2, y, 4), 1.0 - expected, 0.01) << at.z;
    }
}

// A wall at .1, .25 and .5 radii hides what is nearer than the radius: accessibility .563, .656, .805.
TEST_F(Ssdo, AccessibilityAtAWallIsThatOfStepMembership) {
    constexpr int size = 128;
    TracedFrame f(gpu(), {size, size}, floor_and_wall);
    int y = 107;
    glm::vec3 ray = f.ray(size / 2, y + 2), at = glm::vec3(0, 1, 0) - ray / ray.y;
    float distance = at.z - wall_z;
    for (auto [a, expected] : {std::pair(0.25f, 0.656), std::pair(0.5f, 0.805)}) {
        TracedResult r = f.run(exact + std::to_string(distance / a));
        EXPECT_NEAR(mean_over_block(r.accessibility, size / 2 - 2, y, 4), expected, 0.015) << a;
    }
}

TEST_F(Ssdo, EnvironmentKeepsItsDirections) {
    constexpr int size = 128;
    TracedFrame f(gpu(), {size, size}, [](glm::vec3 o, glm::vec3 ray) {
        TracedSurface s = floor_and_wall(o, ray);
        s.radiance = glm::vec3(0);
        return s;
    });
    // Radiance 1 + z: the wall hides the dark side.
    shared::AmbientParams sky{};
    sky.sh[0] = glm::vec3(1.0f / 0.2820948f), sky.sh[2] = glm::vec3(1.0f / 0.4886025f);
    f.set_environment(sky);
    TracedResult r = f.run(exact + "100");
    Image ambient = gpu().read(f.frame.ambient);
    for (int y : {98, 118}) {
        int x = size / 2 - 2;
        glm::vec3 ray = f.ray(size / 2, y + 2), at = glm::vec3(0, 1, 0) - ray / ray.y;
        double open = mean_over_block(r.accessibility, x, y, 4),
               unoccluded = mean_over_block(ambient, x, y, 4);
        double seen =
            cosine_mean([&](glm::vec3 d) { return meets_wall(at, d, 100.0f) ? 0.0 : 1.0 + double(d.z); });
        EXPECT_NEAR(mean_over_block(r.radiance, x, y, 4) + open * unoccluded, seen, 0.01) << at.z;
        EXPECT_GT(seen, open * unoccluded * 1.05);
    }
}

// In a furnace what is hidden of the environment comes back from what hides it.
TEST_F(Ssdo, FurnaceStaysUniform) {
    TracedFrame f(gpu(), {96, 64}, box_of(glm::vec3(0.5f), glm::vec3(0.8f)));
    shared::AmbientParams sky{};
    sky.sh[0] = glm::vec3(0.8f / 0.2820948f);
    f.set_environment(sky);
    for (const char* use : {"ssdo:thickness=0", "ssdo:thickness=0,resolution=full,blur=0"}) {
        TracedResult r = f.run(use);
        for (int y = 0; y < 64; ++y)
            for (int x = 0; x < 96; ++x)
                EXPECT_NEAR(r.radiance.rgb(x, y).x + *r.accessibility.at(x, y) * 0.4f, 0.4f, 2e-3f);
    }
}

TEST_F(Ssdo, OpenPlaneSendsNothingToItselfAtAnyAngle) {
    for (float degrees : {0.0f, 30.0f, 60.0f, 75.0f, 85.0f}) {
        float a = degrees * shared::PI / 180;
        glm::vec3 n(0, std::sin(a), std::cos(a));
        TracedFrame f(gpu(), {96, 64}, [&](glm::vec3, glm::vec3 ray) -> TracedSurface {
            float t = -1.0f / glm::dot(n, ray);
            if (t <= 0 || t > 100) return {};
            return {t, n, glm::vec3(0.8f), glm::vec3(1)};
        });
        for (const char* use : {"ssdo", "ssdo:resolution=full,blur=0", "ssdo:mode=paper"}) {
            TracedResult r = f.run(use);
            for (float v : r.radiance.data) ASSERT_NEAR(v, 0.0f, 1e-6f) << use << " at " << degrees;
            for (float v : r.accessibility.data) ASSERT_NEAR(v, 1.0f, 1e-6f) << use << " at " << degrees;
        }
    }
}

TEST_F(Ssdo, BlackSurfacesSendNothing) {
    TracedFrame dark(gpu(), {64, 64}, box_of(glm::vec3(0.5f), glm::vec3(0)));
    TracedFrame black(gpu(), {64, 64}, box_of(glm::vec3(0), glm::vec3(1)));
    for (const char* use : {"ssdo", "ssdo:mode=paper"})
        for (const TracedFrame* f : {&dark, &black})
            for (float v : f->run(use).radiance.data) ASSERT_EQ(v, 0.0f) << use;
}

TEST_F(Ssdo, IsLinearInTheLightAndFinite) {
    TracedFrame one(gpu(), {64, 64}, box_of(glm::vec3(0.5f), glm::vec3(1)));
    TracedFrame ten(gpu(), {64, 64}, box_of(glm::vec3(0.5f), glm::vec3(10)));
    for (const char* use : {"ssdo", "ssdo:mode=paper"}) {
        Image a = one.run(use).radiance, b = ten.run(use).radiance;
        double sum = 0;
        for (std::size_t i = 0; i < a.data.size(); ++i) {
            ASSERT_TRUE(std::isfinite(a.data[i]));
            ASSERT_NEAR(b.data[i], 10 * a.data[i], 1e-5f * std::abs(b.data[i]) + 1e-7f);
            sum += double(a.data[i]);
        }
        EXPECT_GT(sum, 0.0);
    }
}

// The published bounce at the foot of a wall, summed by its own rule: all that is compared is the shader.
TEST_F(Ssdo, PaperSendersHaveTheAreaOfTheirShareOfTheDisc) {
    constexpr int size = 128;
    TracedFrame f(gpu(), {size, size}, floor_and_wall);
    TracedResult r = f.run("ssdo:mode=paper,samples=1024,radius=1,blur=0,resolution=full");
    int y = 106;
    glm::vec3 ray = f.ray(size / 2, y), at = glm::vec3(0, 1, 0) - ray / ray.y;
    double expected = 0;
    constexpr int n = 100;
    for (int i = 0; i < n * n * n; ++i) {
        glm::vec2 u((float(i % n) + 0.5f) / n, (float(i / n % n) + 0.5f) / n);
        glm::vec3 d = shared::sample_uniform_hemisphere(u), point = at;
        point += glm::vec3(d.x, d.z, d.y) * ((float(i / n / n) + 0.5f) / n);
        if (point.z > wall_z) continue;
        // The pixel in front of a point behind the wall; the paper's distance is clamped to 1.
        glm::vec3 eye(0, 1, 0), sender = eye + (point - eye) * (wall_z / point.z), to = sender - at;
        double d2 = double(glm::dot(to, to)), cosines = double(to.y * -to.z) / d2;
        expected += std::numbers::pi * std::max(cosines, 0.0) / std::max(d2, 1.0) / (n * n * n);
    }
    double sum = 0;
    for (int x = 32; x < 96; ++x) sum += double(r.radiance.at(x, y)[0]) / 64;
    EXPECT_NEAR(sum * std::numbers::pi / expected, 1.0, 0.05);
}

TEST(SsdoRays, HomogeneousPixelsAreWhereWorldPositionsProject) {
    shared::ViewParams v{};
    v.position = {1, 2, 3}, v.forward = {0, 0, -1}, v.right = {1.5f, 0, 0}, v.up = {0, 0.7f, 0};
    v.width = 640, v.height = 480;
    for (glm::vec2 pixel : {glm::vec2(0.5f, 0.5f), glm::vec2(100, 400), glm::vec2(639, 3)}) {
        glm::vec3 h = shared::homogeneous_pixel(v, shared::world_position(v, pixel, 7.0f));
        EXPECT_NEAR(h.z, 7.0f, 1e-5f);
        EXPECT_NEAR(h.x / h.z, pixel.x, 1e-2f);
        EXPECT_NEAR(h.y / h.z, pixel.y, 1e-2f);
    }
}

TEST(SsdoRays, EndInsideTheImage) {
    shared::ViewParams v{};
    v.forward = {0, 0, -1}, v.right = {1, 0, 0}, v.up = {0, 1, 0}, v.width = v.height = 100, v.near = 0.1f;
    glm::vec3 from(0.2f, -0.3f, -2);
    for (int i = 0; i < 1000; ++i) {
        glm::vec3 d = shared::sample_sphere({(float(i) + 0.5f) / 1000, std::fmod(float(i) * 0.618f, 1.0f)});
        glm::vec3 h0 = shared::homogeneous_pixel(v, from), h1 = shared::homogeneous_pixel(v, from + d) - h0;
        float t = shared::length_in_view(v, h0, h1, 1000.0f);
        glm::vec3 end = h0 + t * h1, beyond = h0 + 1.05f * t * h1;
        EXPECT_TRUE(end.z > 0.09f && end.x > 0 && end.y > 0 && end.x < 100 * end.z && end.y < 100 * end.z);
        bool outside = beyond.z < 0.1f || beyond.x < 0.1f * beyond.z || beyond.y < 0.1f * beyond.z ||
                       beyond.x > 99.9f * beyond.z || beyond.y > 99.9f * beyond.z;
        EXPECT_TRUE(outside || t == 1000.0f);
    }
}

} // namespace
} // namespace luxel
