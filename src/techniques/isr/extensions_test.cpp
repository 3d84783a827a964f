// SPDX-License-Identifier: MIT
// Patches beyond what the frame shows: closed forms, and equality where they have nothing to add.
#include "techniques/isr/patches.h"
#include "techniques/isr/test_frame.h"
#include "techniques/isr/view_params.h"

namespace luxel {
namespace {

using testing::Analytic;
using testing::corner_form_factor;
using testing::floor_and_wall;
using testing::floor_z;
using testing::IsrTestFrame;
using testing::mean_over_block;

constexpr int size = 256;

// E/pi of the floor in rows between the wall and the eye, where `expected` gives its closed form by distance
// from the wall.
void expect_floor(const IsrTestFrame& f, const Image& radiance, double wall_z,
                  const std::function<double(double)>& expected, double tolerance) {
    for (int y : {205, 220, 240}) {
        double distance = std::abs(floor_z(f.frame.view, float(y) + 4.0f) - wall_z);
        EXPECT_NEAR(mean_over_block(radiance, size / 2 - 4, y, 8) / expected(distance), 1.0, tolerance)
            << "distance " << distance;
    }
}

TEST(IsrBorder, ReceivesTheFormFactorOfTheWiderView) {
    // Half an image more on each side: the wall is seen in x of [-4, 4], y of [0, 5].
    IsrTestFrame f(size, size, floor_and_wall);
    auto [radiance, open] = f.run(
        {{"samples", "256"}, {"radius", "3"}, {"blur", "0"}, {"resolution", "full"}, {"border", "0.5"}});
    expect_floor(
        f, radiance, -2, [](double d) { return 2 * corner_form_factor(5, 4, d); }, 0.03);
}

// Floor that ends behind the camera at a wall z = 2, radiance 1.
Analytic wall_behind(glm::vec3 o, glm::vec3 ray) {
    return floor_and_wall(glm::vec3(o.x, o.y, -o.z), glm::vec3(ray.x, ray.y, -ray.z));
}

TEST(IsrCameras, ReceiveTheFormFactorOfAWallBehind) {
    IsrTestFrame f(size, size, [](glm::vec3 o, glm::vec3 ray) {
        Analytic a = wall_behind(o, ray);
        a.normal.z = -a.normal.z;
        return a;
    });
    // The camera that looks back sees x of [-2, 2], y of [0, 3].
    auto [radiance, open] = f.run({{"cameras", "1"}, {"camera_samples", "256"}});
    expect_floor(
        f, radiance, 2, [](double d) { return 2 * corner_form_factor(3, 2, d); }, 0.03);
}

TEST(IsrCameras, CountNoSurfaceTwice) {
    // Frame, border and cameras together see an infinite wall, some of it in several of them: a point on the
    // floor sees it in half of its cosine-weighted hemisphere.
    IsrTestFrame f(size, size, floor_and_wall);
    auto [radiance, open] = f.run({{"samples", "256"},
                                   {"radius", "3"},
                                   {"border", "0.25"},
                                   {"cameras", "5"},
                                   {"camera_samples", "512"}});
    expect_floor(
        f, radiance, -2, [](double) { return 0.5; }, 0.04);
}

TEST(IsrCameras, CoverAllDirectionsOnce) {
    shared::ViewParams view = testing::view_from(3, 64, 48);
    std::vector<shared::ViewParams> cameras = isr_cameras(view, 5, 64);
    cameras.push_back(isr_cameras(cameras[0], 1, 64)[0]); // back of back: the front
    for (int i = 0; i < 1000; ++i) {
        glm::vec2 u = shared::isr_even_point(i, 0.3f, 0.6f);
        float z = 2 * u.x - 1, phi = 2 * shared::PI * u.y, s = std::sqrt(1 - z * z);
        glm::vec3 p = view.position + glm::vec3(s * std::cos(phi), s * std::sin(phi), z);
        int seen = 0;
        for (const shared::ViewParams& c : cameras) {
            shared::IsrProjection at = shared::isr_project(c, p);
            seen += at.depth > 0 && at.pixel.x >= 0 && at.pixel.x < 64 && at.pixel.y >= 0 && at.pixel.y < 64;
            EXPECT_NEAR(dot(cross(c.right, c.up), -c.forward), 1.0f, 1e-5f); // not mirrored
        }
        EXPECT_EQ(seen, 1);
    }
}

TEST(IsrCameras, ProjectionInvertsWorldPosition) {
    shared::ViewParams v = testing::view_from(1.5f, 200, 120);
    for (int i = 0; i < 100; ++i) {
        glm::vec2 pixel = shared::isr_even_point(i, 0.1f, 0.9f) * glm::vec2(200, 120);
        float z = 0.5f + float(i);
        shared::IsrProjection p = shared::isr_project(v, world_position(v, pixel, z));
        EXPECT_NEAR(p.pixel.x, pixel.x, 1e-3f);
        EXPECT_NEAR(p.pixel.y, pixel.y, 1e-3f);
        EXPECT_NEAR(p.depth / z, 1.0f, 1e-5f);
    }
}

// A black plate stands 0.1 m before the wall and hides it.
Analytic floor_and_plate(glm::vec3 o, glm::vec3 ray) {
    Analytic a = floor_and_wall(o, ray);
    float to_plate = ray.z < 0 ? (1.9f + o.z) / -ray.z : 1e30f;
    return a.t > 0 && a.t < to_plate ? a : Analytic{to_plate, {0, 0, 1}, glm::vec3(0), glm::vec3(0)};
}

TEST(IsrLayers, HiddenWallSendsItsLight) {
    IsrTestFrame f(size, size, floor_and_plate);
    f.hidden = [](glm::vec3 o, glm::vec3 ray) {
        Analytic a = floor_and_wall(o, ray);
        return a.normal.z > 0 ? a : Analytic{};
    };
    std::vector<std::pair<std::string, std::string>> options = {
        {"samples", "256"}, {"radius", "2"}, {"blur", "0"}, {"resolution", "full"}, {"layers", "1"}};
    Image one = f.run(options).first;
    EXPECT_EQ(*std::max_element(one.data.begin(), one.data.end()), 0.0f);
    options.back().second = "2";
    expect_floor(
        f, f.run(options).first, -2, [](double d) { return 2 * corner_form_factor(3, 2, d); }, 0.03);
}

// A lit corner that lies inside of the frame as a whole.
Analytic small_corner(glm::vec3 o, glm::vec3 ray) {
    Analytic a = floor_and_wall(o, ray);
    glm::vec3 p = o + ray * a.t;
    if (a.t <= 0 || std::abs(p.x) > 0.6f || p.y > 1.5f || p.z > -1.3f) return {};
    return a;
}

TEST(IsrExtensions, ChangeNoBitWhereTheyHaveNothingToAdd) {
    IsrTestFrame f(101, 76, small_corner);
    auto [plain, open] = f.run({});
    EXPECT_GT(*std::max_element(plain.data.begin(), plain.data.end()), 0.05f);
    for (const char* name : {"border=0.3", "cameras=5", "layers=2", "samples_far=80", "temporal=8"}) {
        std::string text = name;
        std::size_t equal = text.find('=');
        auto [image, accessibility] = f.run({{text.substr(0, equal), text.substr(equal + 1)}});
        EXPECT_EQ(image.data, plain.data) << name;
        EXPECT_EQ(accessibility.data, open.data) << name;
    }
}

TEST(IsrExtensions, ReceiversBeyondFarTakeTheirOwnSamples) {
    IsrTestFrame f(101, 76, floor_and_wall);
    Image many = f.run({{"blur", "0"}, {"resolution", "full"}, {"samples", "80"}}).first;
    Image few = f.run({{"blur", "0"}, {"resolution", "full"}, {"samples", "24"}}).first;
    Image both = f.run({{"blur", "0"}, {"resolution", "full"}, {"samples_far", "24"}, {"far", "1.5"}}).first;
    Image depth = f.gpu.read(f.frame.gbuffer.depth);
    int near = 0, far = 0;
    for (int y = 0; y < 76; ++y)
        for (int x = 0; x < 101; ++x) {
            bool is_far = *depth.at(x, y) > 1.5f;
            ++(is_far ? far : near);
            // Upsampling mixes a trace of the neighbors in, which may lie on the other side.
            float expected = (is_far ? few : many).at(x, y)[0];
            EXPECT_NEAR(both.at(x, y)[0], expected, 1e-3f * expected);
        }
    EXPECT_GT(near, 1000);
    EXPECT_GT(far, 1000);
}

TEST(IsrExtensions, CamerasAreForTheCalibratedModeOnly) {
    IsrTestFrame f(16, 16, floor_and_wall);
    EXPECT_THROW(f.run({{"mode", "thesis"}, {"cameras", "1"}}), std::exception);
}

} // namespace
} // namespace luxel
