// SPDX-License-Identifier: MIT
// Impostors in the frame against the meshes that they stand for.
#include "techniques/frame/impostors.h"

#include <algorithm>

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include "scene/procedural.h"
#include "scene/procedural_parts.h"
#include "support/gpu.h"
#include "techniques/frame/renderer.h"

namespace luxel {
namespace {

constexpr int side = 128; // pixels

// Three balls of one role at different depths, one of them a mirror, before a wall.
Scene balls() {
    Scene scene;
    scene.name = "balls";
    procedural::add_quad_object(scene, procedural::lambertian("wall", glm::vec3(0.5f)), {-4, -4, -2},
                                {8, 0, 0}, {0, 8, 0});
    const glm::vec3 centers[] = {{-0.5f, 0.3f, 0.5f}, {0.45f, -0.1f, 0.0f}, {0.1f, 0.4f, -0.5f}};
    const glm::vec3 colors[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (int i = 0; i < 3; ++i) {
        Material m = procedural::lambertian("ball", colors[i]);
        if (i == 2) m = procedural::mirror("ball", {0.9f, 0.8f, 0.7f});
        add_sphere(procedural::add_object(scene, m), centers[i], 0.3f, 64, 32);
        scene.instances.back().role = "balls";
    }
    scene.lights = {procedural::point_light({1, 2, 3}, 20.0f)};
    scene.cameras = {procedural::camera_at({0.2f, 0.3f, 3.2f}, {0, 0.2f, 0}, 40.0f)};
    return scene;
}

Scene with_impostor(Scene scene, const Impostor& impostor, const std::string& name = "ball") {
    for (Instance& i : scene.instances)
        if (i.name.starts_with(name)) i.impostor = impostor;
    return scene;
}

bool redrawn(const RenderResult& r) {
    return std::any_of(r.passes.begin(), r.passes.end(), [](const gpu::PassTime& p) {
        return p.name.find("impostor redraw") != std::string::npos;
    });
}

// Least and most of a channel at a pixel and beside it.
std::pair<float, float> range_about(const Image& image, int x, int y, int channel) {
    std::pair<float, float> range{1e30f, -1e30f};
    for (int v = std::max(y - 1, 0); v <= std::min(y + 1, image.height - 1); ++v)
        for (int u = std::max(x - 1, 0); u <= std::min(x + 1, image.width - 1); ++u) {
            range.first = std::min(range.first, image.at(u, v)[channel]);
            range.second = std::max(range.second, image.at(u, v)[channel]);
        }
    return range;
}

class ImpostorsTest : public testing::GpuTest {
protected:
    RenderRequest request(const Scene& scene) const {
        return {.camera = scene.cameras.at(0),
                .width = side,
                .height = side,
                .images = {"depth", "hardware_depth", "diffuse", "normal", "geometric_normal", "specular",
                           "direct"}};
    }
    RenderResult render(const Scene& scene) {
        return Renderer(gpu(), scene, FrameOptions{}).render(request(scene));
    }
};

// Samples are half a texel beside their pixel at most, and a texel is smaller than a pixel here: every value
// lies among those that the mesh has at the pixel and beside it.
TEST_F(ImpostorsTest, ANailboardSeenFromItsOwnEyeIsTheMesh) {
    const Scene scene = balls();
    const RenderResult mesh = render(scene);
    const RenderResult nail = render(with_impostor(scene, {.kind = ImpostorKind::nailboard, .size = 256}));
    EXPECT_TRUE(redrawn(nail));
    EXPECT_FALSE(redrawn(mesh));
    const struct {
        const char* image;
        float slack;    // rounding to 16 bits, interpolation
        int exceptions; // at outlines a normal turns by more than its neighbors show within a pixel
    } images[] = {{"depth", 2e-3f, 0},
                  {"diffuse", 1e-3f, 0},
                  {"specular", 1e-3f, 0},
                  {"normal", 2e-3f, side},
                  {"geometric_normal", 2e-3f, side}};
    for (const auto& [name, slack, exceptions] : images) {
        const Image &a = mesh.images.at(name), &b = nail.images.at(name);
        int outside = 0;
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x)
                for (int c = 0; c < b.channels; ++c) {
                    const auto [least, most] = range_about(a, x, y, c);
                    outside += b.at(x, y)[c] < least - slack || b.at(x, y)[c] > most + slack;
                }
        EXPECT_LE(outside, exceptions) << name;
    }
    // The depth that the depth test saw is that of the samples.
    const float near = scene.cameras[0].near;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x)
            ASSERT_NEAR(*nail.images.at("hardware_depth").at(x, y), near / *nail.images.at("depth").at(x, y),
                        1e-6f);

    // Off edges the light is the same too; the mirror's index of refraction came along.
    double difference = 0.0, sum = 0.0;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const auto [least, most] = range_about(mesh.images.at("direct"), x, y, 3);
            EXPECT_GE(nail.images.at("direct").at(x, y)[3], least);
            EXPECT_LE(nail.images.at("direct").at(x, y)[3], most);
            difference += double(glm::length(mesh.radiance.rgb(x, y) - nail.radiance.rgb(x, y)));
            sum += double(glm::length(mesh.radiance.rgb(x, y)));
        }
    EXPECT_LT(difference / sum, 0.02);
}

// Center of the pixels of one color, and how many there are.
struct Blob {
    glm::vec2 center{0.0f};
    int pixels = 0;
};
Blob blob(const Image& diffuse, int channel) {
    Blob b;
    for (int y = 0; y < diffuse.height; ++y)
        for (int x = 0; x < diffuse.width; ++x) {
            const glm::vec3 c = diffuse.rgb(x, y);
            if (c[channel] < 0.9f || c.r + c.g + c.b > 1.1f) continue;
            b.center += glm::vec2(x, y), ++b.pixels;
        }
    b.center /= float(std::max(b.pixels, 1));
    return b;
}

// Balls of one color each, small and apart; the camera goes around them in steps of a degree.
struct Walk {
    int redraws = 0;
    float farthest = 0.0f; // pixels between a ball and where the impostor shows it
    float last = 0.0f;
};
Walk walk_around(gpu::Gpu& gpu, float error) {
    Scene scene;
    scene.name = "walk";
    const glm::vec3 centers[] = {{0, 0, 0.6f}, {-0.6f, 0.3f, 0}, {0.6f, 0.3f, -0.6f}};
    for (int i = 0; i < 3; ++i) {
        glm::vec3 color(0.0f);
        color[i] = 1.0f;
        add_sphere(procedural::add_object(scene, procedural::lambertian("ball", color)), centers[i], 0.12f,
                   32, 16);
        scene.instances.back().role = "balls";
    }
    scene.lights = {procedural::point_light({0, 3, 3}, 20.0f)};
    const Scene other = with_impostor(scene, {.kind = ImpostorKind::nailboard, .error = error});
    Renderer meshes(gpu, scene, FrameOptions{}), impostors(gpu, other, FrameOptions{});
    Walk walk;
    for (int step = 0; step <= 12; ++step) {
        const float angle = procedural::radians(float(step));
        const Camera camera = procedural::camera_at(glm::vec3(std::sin(angle), 0.2f, std::cos(angle)) * 4.0f,
                                                    glm::vec3(0.0f), 30.0f);
        const RenderRequest request{.camera = camera, .width = side, .height = side, .images = {"diffuse"}};
        const RenderResult a = meshes.render(request), b = impostors.render(request);
        walk.redraws += redrawn(b) ? 1 : 0;
        walk.last = 0.0f;
        for (int i = 0; i < 3; ++i) {
            const Blob x = blob(a.images.at("diffuse"), i), y = blob(b.images.at("diffuse"), i);
            EXPECT_GT(x.pixels, 30);
            EXPECT_GT(y.pixels, 30);
            walk.last = std::max(walk.last, glm::length(x.center - y.center));
        }
        walk.farthest = std::max(walk.farthest, walk.last);
    }
    return walk;
}

// A ball's center of pixels is right to half a pixel in either image.
TEST_F(ImpostorsTest, PointsAreDisplacedByNoMoreThanTheErrorBeforeTheRedraw) {
    for (float error : {1.0f, 2.0f, 4.0f}) {
        const Walk walk = walk_around(gpu(), error);
        EXPECT_GT(walk.redraws, 1) << error;
        EXPECT_LT(walk.farthest, error + 1.0f);
        if (error > 1.0f) {
            EXPECT_LT(walk.redraws, 13) << error;
            EXPECT_GT(walk.farthest, error * 0.25f);
        }
    }
    const Walk never = walk_around(gpu(), 1e4f);
    EXPECT_EQ(never.redraws, 1);
    EXPECT_GT(never.last, 5.0f);
    EXPECT_EQ(never.last, never.farthest); // still growing
}

// A sheet cuts a ball before its center, on the right. In front of the sheet the ball has to win: the
// nailboard's does, the billboard's does not, whose plane is behind the sheet.
TEST_F(ImpostorsTest, OnlyANailboardIsCutAsTheMeshIs) {
    Scene scene;
    scene.name = "cut";
    add_sphere(procedural::add_object(scene, procedural::lambertian("ball", {1, 0, 0})), {0, 0, 0}, 0.5f, 64,
               32);
    procedural::add_quad_object(scene, procedural::lambertian("sheet", {0, 1, 0}), {0, -1, 0.2f}, {1, 0, 0},
                                {0, 2, 0});
    scene.lights = {procedural::point_light({0, 1, 4}, 20.0f)};
    scene.cameras = {procedural::camera_at({0, 0, 4}, {0, 0, 0}, 20.0f)};
    const Image truth = render(scene).images.at("diffuse");
    int wrong[2] = {}, hidden = 0;
    for (ImpostorKind kind : {ImpostorKind::billboard, ImpostorKind::nailboard}) {
        const Image image = render(with_impostor(scene, {.kind = kind})).images.at("diffuse");
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x) {
                wrong[kind == ImpostorKind::nailboard] +=
                    glm::length(image.rgb(x, y) - truth.rgb(x, y)) > 0.5f;
                hidden += x > side / 2 && truth.rgb(x, y).r > 0.5f;
            }
    }
    hidden /= 2;
    EXPECT_GT(hidden, 500);
    EXPECT_GT(wrong[0], hidden * 95 / 100);
    EXPECT_LT(wrong[1], side); // pixels of the outline
}

// A cloud is no larger than its distance allows and covers nearly all of the object, from all sides.
TEST_F(ImpostorsTest, ACloudIsWithinItsDistanceOfTheMesh) {
    Scene scene;
    scene.name = "cloud";
    add_sphere(procedural::add_object(scene, procedural::lambertian("ball", {1, 0, 0})), {0, 0, 0}, 0.5f, 48,
               24);
    scene.lights = {procedural::point_light({1, 2, 4}, 20.0f)};
    const float distance = 0.02f;
    const Scene other = with_impostor(scene, {.kind = ImpostorKind::billboard_cloud, .distance = distance});
    Renderer meshes(gpu(), scene, FrameOptions{}), clouds(gpu(), other, FrameOptions{});
    int redraws = 0;
    for (glm::vec3 eye : {glm::vec3(0, 0, 4), glm::vec3(3, 2, -1), glm::vec3(-2, -3, 1)}) {
        const RenderRequest request{.camera = procedural::camera_at(eye, glm::vec3(0.0f), 20.0f),
                                    .width = side,
                                    .height = side,
                                    .images = {"depth"}};
        const RenderResult a = meshes.render(request), b = clouds.render(request);
        redraws += redrawn(b) ? 1 : 0;
        // The ball's outline is a circle; the cloud's is at most the distance and a pixel outside.
        const float per_pixel = 2.0f * std::tan(procedural::radians(10.0f)) / float(side);
        const float d = glm::length(eye);
        const float outer = (0.5f + distance) / std::sqrt(d * d - 0.25f) / per_pixel + 2.0f;
        int covered = 0, missed = 0, stray = 0;
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x) {
                const bool in_mesh = *a.mask.at(x, y) > 0.0f, in_cloud = *b.mask.at(x, y) > 0.0f;
                const float r = glm::length(glm::vec2(x, y) + 0.5f - glm::vec2(float(side) / 2));
                stray += in_cloud && r > outer;
                missed += in_mesh && !in_cloud;
                covered += in_mesh && in_cloud;
            }
        EXPECT_EQ(stray, 0);
        EXPECT_LT(missed, covered / 50);
    }
    EXPECT_EQ(redraws, 1);
}

TEST_F(ImpostorsTest, FromTooCloseTheMeshIsDrawn) {
    Scene scene = balls();
    scene.cameras[0].position = {0.0f, 0.2f, 0.3f}; // within the box around the balls
    const RenderResult mesh = render(scene);
    const RenderResult nail = render(with_impostor(scene, {.kind = ImpostorKind::nailboard}));
    EXPECT_EQ(mesh.radiance.data, nail.radiance.data);
}

// A nailboard is drawn anew; a cloud moves, and is chosen anew only when its parts move apart.
TEST_F(ImpostorsTest, FollowWhatMoves) {
    const glm::mat4 motion =
        glm::translate(glm::rotate(glm::mat4(1.0f), 0.7f, {0.3f, 1, 0.2f}), {0.3f, -0.2f, 0.2f});
    for (ImpostorKind kind : {ImpostorKind::nailboard, ImpostorKind::billboard_cloud}) {
        Scene scene = balls();
        scene.materials[3].roughness = 1.0f; // no mirror: all is lit
        scene =
            with_impostor(scene, {.kind = kind, .distance = kind == ImpostorKind::nailboard ? 0.0f : 0.01f});
        Renderer renderer(gpu(), scene, FrameOptions{});
        renderer.render(request(scene));
        EXPECT_FALSE(redrawn(renderer.render(request(scene))));
        for (bool apart : {false, true}) {
            for (Instance& i : scene.instances)
                if (i.name == "ball") i.transform = motion * i.transform;
            if (apart) scene.instances.back().transform[3].y += 0.3f;
            renderer.update_motion();
            const RenderResult now = renderer.render(request(scene));
            EXPECT_EQ(redrawn(now), apart || kind == ImpostorKind::nailboard);
            const Image mesh = render(with_impostor(scene, {})).radiance;
            double difference = 0.0, sum = 0.0;
            for (std::size_t i = 0; i < mesh.data.size(); ++i)
                difference += double(std::abs(mesh.data[i] - now.radiance.data[i])),
                    sum += double(mesh.data[i]);
            EXPECT_LT(difference / sum, kind == ImpostorKind::nailboard ? 0.02 : 0.06) << apart;
        }
    }
}

// Captures that techniques ask for show meshes; behind the frame's own depth there is nothing of an impostor.
class Behind final : public Technique {
public:
    Slot slot() const override { return Slot::post; }
    Contribution render(gpu::Recorder& recorder, const Frame& frame) override {
        frame.capture(recorder, {.view = frame.view, .prefix = "own "});
        frame.capture(recorder, {.view = frame.view,
                                 .prefix = "behind ",
                                 .farther_than = frame.gbuffer.depth,
                                 .behind_frame = true});
        return {};
    }
};
TEST_F(ImpostorsTest, CapturesShowMeshesAndNothingBehindAnImpostor) {
    Behind technique;
    const auto capture = [&](const Scene& scene) {
        RenderRequest r = request(scene);
        r.techniques = {&technique};
        r.images = {"depth", "own depth", "behind diffuse"};
        return Renderer(gpu(), scene, FrameOptions{}).render(r);
    };
    const Scene scene = balls();
    const RenderResult mesh = capture(scene);
    const RenderResult board = capture(with_impostor(scene, {.kind = ImpostorKind::billboard}));
    EXPECT_EQ(board.images.at("own depth").data, mesh.images.at("depth").data);
    int red = 0, wall = 0;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const glm::vec3 c = board.images.at("behind diffuse").rgb(x, y);
            red += c.r > 0.9f || c.g > 0.9f;
            wall += std::abs(c.r - 0.5f) < 0.01f;
        }
    EXPECT_EQ(red, 0);
    EXPECT_GT(wall, 1000);
}

// Bounces of light and mirror images start at the impostors' surfaces as they do at the meshes'.
TEST_F(ImpostorsTest, TechniquesTakeANailboardForTheMesh) {
    for (const char* use : {"isr:samples=24", "distance_map:size=64"}) {
        Image images[2];
        for (bool nailboard : {false, true}) {
            auto technique = make_technique(parse_specification(use));
            const Scene scene =
                with_impostor(balls(), {.kind = nailboard ? ImpostorKind::nailboard : ImpostorKind::none});
            RenderRequest r = request(scene);
            r.techniques = {technique.get()};
            images[nailboard] = Renderer(gpu(), scene, FrameOptions{}).render(r).radiance;
        }
        double difference = 0.0, sum = 0.0;
        for (std::size_t i = 0; i < images[0].data.size(); ++i)
            difference += double(std::abs(images[0].data[i] - images[1].data[i])),
                sum += double(images[0].data[i]);
        EXPECT_LT(difference / sum, 0.03) << use;
    }
}

// The height map of a wall: its nailboard has the relief that the technique found, and loses it without one.
TEST_F(ImpostorsTest, ANailboardKeepsAReliefAndFollowsItsSearch) {
    const Scene scene = relief();
    const Scene other = with_impostor(scene, {.kind = ImpostorKind::nailboard, .size = 512}, "wall");
    auto technique = make_technique(parse_specification("relief"));
    auto again = make_technique(parse_specification("relief"));
    RenderRequest with = request(scene), without = request(scene);
    with.techniques = {technique.get()};
    const Image truth = Renderer(gpu(), scene, FrameOptions{}).render(with).images.at("depth");
    with.techniques = {again.get()};
    Renderer renderer(gpu(), other, FrameOptions{});
    const Image flat = renderer.render(without).images.at("depth");
    const RenderResult deep = renderer.render(with);
    EXPECT_TRUE(redrawn(deep));
    double of_flat = 0.0, of_deep = 0.0;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            of_flat += double(std::abs(*flat.at(x, y) - *truth.at(x, y)));
            of_deep += double(std::abs(*deep.images.at("depth").at(x, y) - *truth.at(x, y)));
        }
    EXPECT_LT(of_deep, of_flat * 0.3);
}

} // namespace
} // namespace luxel
