// SPDX-License-Identifier: MIT
// Exact means of emission against sums over many points, and against closed forms.
#include "scene/emission_mean.h"

#include <cmath>

#include <gtest/gtest.h>

#include "scene/lights.h"
#include "scene/surface.h"
#include "shared/random.h"

namespace luxel {
namespace {

Texture black_texture(int width, int height) {
    Texture t;
    t.pixels.width = width, t.pixels.height = height;
    t.pixels.rgba.assign(std::size_t(width) * std::size_t(height) * 4, 0);
    return t;
}
void set(Texture& t, int x, int y, int channel, int code) {
    t.pixels.rgba[std::size_t((y * t.pixels.width + x) * 4 + channel)] = std::uint8_t(code);
}
Texture noise(int width, int height, std::uint32_t seed) {
    Texture t = black_texture(width, height);
    for (std::size_t i = 0; i < t.pixels.rgba.size(); ++i)
        t.pixels.rgba[i] = std::uint8_t(shared::hash2(seed, std::uint32_t(i)) >> 24);
    return t;
}

// One triangle that emits (1, 2, 3) times texture 0; texture 1 has its mask.
Scene triangle(Texture emission, std::array<glm::vec2, 3> uv) {
    Scene scene;
    scene.textures = {std::move(emission)};
    Material m;
    m.emission = {1, 2, 3};
    m.emission_texture.texture = 0;
    scene.materials = {m};
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.normals.assign(3, {0, 0, 1});
    mesh.texcoords[0].assign(uv.begin(), uv.end());
    mesh.indices = {0, 1, 2};
    scene.meshes = {mesh};
    scene.instances = {{}};
    return scene;
}

// By the centroids of n x n equal parts.
glm::dvec3 summed(const Scene& scene, int n) {
    glm::dvec3 sum(0.0);
    for (int i = 0; i < n; ++i)
        for (int j = 0; i + j < n; ++j)
            for (int turned = 0; turned < (i + j + 1 < n ? 2 : 1); ++turned) {
                const double third = turned ? 2.0 / 3.0 : 1.0 / 3.0;
                const glm::vec2 uv((double(i) + third) / n, (double(j) + third) / n);
                if (!is_transparent(scene, 0, 0, uv)) // emission_at() knows what is blended
                    sum += glm::dvec3(emission_at(scene, 0, 0, uv));
            }
    return sum / (double(n) * double(n));
}

void expect_near(const Scene& scene, double tolerance, int steps = 1500) {
    const glm::dvec3 exact(EmissionMeans(scene).mean(0, 0)), expected = summed(scene, steps);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(exact[c], expected[c], tolerance * expected[c] + 1e-7);
}

constexpr std::array<glm::vec2, 3> whole_map = {glm::vec2{0, 0}, glm::vec2{2, 0}, glm::vec2{0, 2}};

} // namespace

TEST(EmissionMean, OneLitSpotIsNotMissed) {
    Texture t = black_texture(512, 512);
    for (int i = 0; i < 25; ++i)
        for (int c = 0; c < 3; ++c) set(t, 300 + i % 5, 71 + i / 5, c, 255);
    Scene scene = triangle(t, {glm::vec2{0, 0}, glm::vec2{1, 0}, glm::vec2{1, 1}});
    // The spot's filter has the integral of its 25 texels, on a triangle that covers half of all.
    const glm::vec3 mean = EmissionMeans(scene).mean(0, 0);
    EXPECT_NEAR(mean.x, 25.0 / (512.0 * 512.0 / 2.0), 1e-8);
    EXPECT_NEAR(mean.z, 3 * mean.x, 1e-8);
    ASSERT_EQ(emissive_triangles(scene).size(), 1u);
    EXPECT_EQ(emissive_triangles(scene)[0].emission, mean);
    // A texel's thousandth of it, and the diagonal through it.
    scene.meshes[0].texcoords[0] = {{0.0f, 0.0f}, {1.0f, 0.0f}, {301.0f / 512.0f, 73.0f / 512.0f}};
    expect_near(scene, 2e-3, 6000);
}

TEST(EmissionMean, AllWrapModesAndFilters) {
    for (const Wrap u : {Wrap::repeat, Wrap::mirror, Wrap::clamp})
        for (const Wrap v : {Wrap::repeat, Wrap::clamp})
            for (const bool nearest : {false, true}) {
                Texture t = noise(7, 5, 1);
                t.srgb = true, t.wrap_u = u, t.wrap_v = v, t.nearest = nearest;
                Scene scene =
                    triangle(t, {glm::vec2{-1.3f, 0.2f}, glm::vec2{1.7f, -0.9f}, glm::vec2{0.4f, 2.1f}});
                scene.materials[0].emission_texture.transform[2] = {0.21f, -0.4f, 1.0f};
                expect_near(scene, nearest ? 2e-3 : 2e-4);
            }
}

TEST(EmissionMean, RepeatedAThousandTimes) {
    Scene scene = triangle(noise(64, 64, 2), {glm::vec2{0, 0}, glm::vec2{1000, 0}, glm::vec2{0, 1000}});
    double sum = 0.0;
    for (std::size_t i = 0; i < scene.textures[0].pixels.rgba.size(); i += 4)
        sum += double(scene.textures[0].pixels.rgba[i]) / 255.0 / (64.0 * 64.0);
    EXPECT_NEAR(EmissionMeans(scene).mean(0, 0).x, sum, 2e-3 * sum);
}

TEST(EmissionMean, CoordinatesOnALineOrAPoint) {
    Scene scene =
        triangle(noise(16, 16, 3), {glm::vec2{0.5f, 0.5f}, glm::vec2{0.5f, 0.5f}, glm::vec2{0.5f, 0.5f}});
    const glm::vec3 at = emission_at(scene, 0, 0, {0.2f, 0.3f}), mean = EmissionMeans(scene).mean(0, 0);
    EXPECT_NEAR(mean.y, at.y, 1e-6f);
    scene.meshes[0].texcoords[0] = {{0.1f, 0.2f}, {0.9f, 0.6f}, {0.5f, 0.4f}};
    expect_near(scene, 1e-4);
    scene.meshes[0].texcoords[0].clear();
    EXPECT_NEAR(EmissionMeans(scene).mean(0, 0).y, emission_at(scene, 0, 0, {}).y, 1e-6f);
}

TEST(EmissionMean, MasksCutOutAndBlendedSurfacesSendTheirShare) {
    for (const bool textured : {true, false}) {
        Scene scene =
            triangle(noise(9, 9, 4), {glm::vec2{0.1f, 0.1f}, glm::vec2{1.2f, 0.0f}, glm::vec2{0.3f, 0.8f}});
        if (!textured) scene.materials[0].emission_texture = {};
        scene.textures.push_back(noise(11, 6, 5));
        Material& m = scene.materials[0];
        m.base_color_texture.texture = 1;
        m.alpha_mode = AlphaMode::mask, m.alpha_cutoff = 0.4f, m.base_color.a = 0.8f;
        expect_near(scene, 3e-3);
        scene.meshes[0].colors = {{1, 1, 1, 1}, {1, 1, 1, 0.3f}, {1, 1, 1, 0.8f}};
        expect_near(scene, 3e-3);
        m.base_color_texture = {}; // vertices alone
        expect_near(scene, 3e-3);
        m.alpha_mode = AlphaMode::blend;
        expect_near(scene, 3e-4);
        m.base_color_texture.texture = 1;
        expect_near(scene, 3e-4);
    }
}

// Half of a panel cut out by a mask, repeated many times: blocks are added up, not walked through.
TEST(EmissionMean, HalfAPanelOfManyRepeats) {
    Texture mask = black_texture(256, 256);
    for (int y = 0; y < 256; ++y)
        for (int x = 0; x < 128; ++x) set(mask, x, y, 3, 255);
    Scene scene = triangle(mask, {glm::vec2{0, 0}, glm::vec2{100, 0}, glm::vec2{0, 100}});
    Material& m = scene.materials[0];
    m.base_color_texture = m.emission_texture, m.emission_texture = {};
    m.alpha_mode = AlphaMode::mask;
    // Half, and of the hundred tiles that the long edge halves three quarters.
    EXPECT_NEAR(EmissionMeans(scene).mean(0, 0).x, 0.5f + 100 * 0.5f * 0.25f / 5000.0f, 1e-4f);
}

} // namespace luxel
