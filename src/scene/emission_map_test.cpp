// SPDX-License-Identifier: MIT
#include "scene/emission_map.h"

#include <gtest/gtest.h>

#include "scene/lights.h"
#include "scene/surface.h"
#include "shared/random.h"

namespace luxel {
namespace {

// A triangle of `repeats` x half a texture of size^2 whose texels are black but for some.
Scene lamp(int size, std::vector<glm::ivec2> lit, float repeats = 1.0f, bool nearest = false) {
    Scene scene;
    Texture texture;
    texture.nearest = nearest;
    texture.pixels = {size, size, std::vector<std::uint8_t>(std::size_t(size) * std::size_t(size) * 4, 0)};
    for (const glm::ivec2 t : lit)
        texture.pixels.rgba[(std::size_t(t.y) * std::size_t(size) + std::size_t(t.x)) * 4] = 255;
    scene.textures.push_back(texture);
    Material m;
    m.emission = {8.0f, 4.0f, 2.0f};
    m.emission_texture.texture = 0;
    scene.materials.push_back(m);
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}};
    mesh.normals.assign(3, {0, 0, 1});
    mesh.texcoords[0] = {{0, 0}, {repeats, 0}, {0, repeats}};
    mesh.indices = {0, 1, 2};
    scene.meshes.push_back(mesh);
    scene.instances.push_back({});
    return scene;
}

// One texel inside is a tent of volume 1 texel, whatever the texture's size: red 8 x 1 / (half of size^2).
TEST(EmissionMap, TheMeanIsThatOfTheFilterToTheLastDigits) {
    for (int size : {8, 64, 512, 1500})
        for (bool nearest : {false, true}) {
            const Scene scene = lamp(size, {{size / 4, size / 3}}, 1.0f, nearest);
            const EmissionMap map(scene, 0, 0);
            ASSERT_TRUE(map.varies());
            EXPECT_NEAR(map.mean().r * float(size) * float(size) / 16.0f, 1.0f, 2e-3f) << size;
            EXPECT_EQ(map.mean().g, 0.0f);
            ASSERT_EQ(emissive_triangles(scene).size(), 1u) << "never dropped";
        }
    // Repeated 20 times in both directions: 190 whole copies lie below the diagonal, and 20 parts of copies.
    const Scene tiled = lamp(16, {{3, 4}}, 20.0f);
    EXPECT_NEAR(EmissionMap(tiled, 0, 0).mean().r, 8.0f / 256.0f * (190.0f + 20.0f) / 200.0f, 1e-3f);
}

// Points by brightness: emission over the density has the mean, with little variance, and densities are those
// that are stated for the point.
TEST(EmissionMap, DrawsPointsByTheirBrightness) {
    const Scene scene = lamp(300, {{70, 90}, {71, 90}, {10, 200}});
    const EmissionMap map(scene, 0, 0);
    double sum = 0.0, squares = 0.0;
    const int n = 4096;
    for (int i = 0; i < n; ++i) {
        const shared::uint k = shared::uint(i);
        const EmissionMap::Drawn d = map.draw({(float(i) + 0.5f) / n, shared::uniform_float(shared::pcg(k))});
        ASSERT_GT(d.density, 0.0f);
        EXPECT_NEAR(map.density(d.uv) / d.density, 1.0f, 0.05f);
        const double v = double(emission_at(scene, 0, 0, d.uv).r / d.density);
        sum += v, squares += v * v;
    }
    const double mean = sum / n, expected = double(map.mean().r);
    EXPECT_NEAR(mean / expected, 1.0, 0.03);
    EXPECT_LT(squares / n, 6.0 * expected * expected)
        << "uniform points would have 15 000 times the mean's square";
}

// Half of the samples' light for each of two lamps, and none beside them.
TEST(EmissionMap, SampleLightsStandOnTheLampAndSumToItsPower) {
    const Scene scene = lamp(512, {{100, 100}, {300, 50}});
    const std::vector<shared::Light> lights = emitter_sample_lights(scene, 64, 1);
    ASSERT_EQ(lights.size(), 64u);
    double sum = 0.0;
    int first = 0;
    for (const shared::Light& l : lights) {
        sum += double(l.intensity.r);
        const glm::vec2 texel = glm::vec2(l.position) * 256.0f - 0.5f;
        const bool at_first = glm::length(texel - glm::vec2(100)) < 3.0f;
        EXPECT_TRUE(at_first || glm::length(texel - glm::vec2(300, 50)) < 3.0f) << texel.x << " " << texel.y;
        first += at_first;
    }
    EXPECT_NEAR(sum, 8.0 * 2.0 * 4.0 / (512.0 * 512.0), 1e-3 * sum) << "radiance x texels x m2 a texel";
    EXPECT_NEAR(first, 32, 4);
}

// A mask that leaves every fourth column: lights stand where there is something, with the light of what there
// is.
TEST(EmissionMap, SampleLightsAvoidHoles) {
    Scene scene = lamp(64, {});
    Material& m = scene.materials[0];
    m.emission_texture.texture = -1, m.base_color_texture.texture = 0, m.alpha_mode = AlphaMode::mask;
    scene.textures[0].nearest = true;
    for (std::size_t i = 0; i < 64u * 64u; ++i)
        scene.textures[0].pixels.rgba[i * 4 + 3] = i % 4 == 0 ? 255 : 0;
    double sum = 0.0;
    for (const shared::Light& l : emitter_sample_lights(scene, 100, 1)) {
        sum += double(l.intensity.r);
        EXPECT_FALSE(is_transparent(scene, 0, 0, glm::vec2(l.position) / 2.0f)) << l.position.x;
    }
    double covered = 0.0; // column i is 63.5 - i texels long below the diagonal
    for (int i = 0; i < 64; i += 4) covered += 63.5 - i;
    EXPECT_NEAR(sum, 8.0 * 2.0 * covered / 2048.0, 1e-3);
}

} // namespace
} // namespace luxel
