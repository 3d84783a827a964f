// SPDX-License-Identifier: MIT
// Alpha masks far away, where texels are smaller than pixels.
#include <gtest/gtest.h>

#include "scene/procedural_parts.h"
#include "techniques/frame/renderer.h"
#include "techniques/frame/texture_levels.h"

namespace luxel {
namespace {

// Cards of 2 m at the given distances, glowing where their mask leaves them: disks on a grid.
Scene cards(const std::vector<float>& distances, float cutoff) {
    Scene scene;
    scene.name = "cards";
    Texture mask;
    constexpr int side = 128, cell = 16;
    mask.pixels.width = mask.pixels.height = side;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const glm::vec2 d = glm::vec2(x % cell, y % cell) + 0.5f - float(cell) / 2;
            const float alpha = glm::clamp(5.5f - glm::length(d), 0.0f, 1.0f);
            mask.pixels.rgba.insert(mask.pixels.rgba.end(), {0, 0, 0, std::uint8_t(alpha * 255.0f)});
        }
    scene.textures = {mask};
    Material m;
    m.emission = glm::vec3(1.0f);
    m.base_color = {0, 0, 0, 1};
    m.metallic = m.specular = 0.0f;
    m.base_color_texture.texture = 0;
    m.alpha_mode = AlphaMode::mask, m.alpha_cutoff = cutoff;
    m.double_sided = true;
    scene.materials = {m};
    scene.meshes.emplace_back();
    // All in one mesh, as the leaves of a tree are.
    for (const float z : distances) add_quad(scene.meshes[0], {-1, -1, -z}, {2, 0, 0}, {0, 2, 0});
    scene.meshes[0].texcoords[0].clear();
    for (std::size_t i = 0; i < distances.size(); ++i)
        for (const glm::vec2 uv : {glm::vec2{0, 1}, glm::vec2{1, 1}, glm::vec2{1, 0}, glm::vec2{0, 0}})
            scene.meshes[0].texcoords[0].push_back(uv);
    scene.instances.emplace_back();
    Camera camera;
    camera.forward = {0, 0, -1};
    scene.cameras = {camera};
    return scene;
}

// How much of the card's square is seen, where the nearest card fills `pixels` of the image's height.
double seen(gpu::Gpu& gpu, Scene scene, float distance, int size, float pixels) {
    scene.cameras[0].yfov = 2.0f * std::atan(float(size) / pixels / distance);
    RenderRequest request{.width = size, .height = size};
    request.camera = scene.cameras[0];
    const RenderResult result = Renderer(gpu, scene, {.environment = EnvironmentMode::none}).render(request);
    double sum = 0.0;
    for (float v : result.radiance.data) sum += double(v) / 3.0;
    return sum / double(pixels) / double(pixels);
}

TEST(Masks, KeepTheirCoverageAtAnySize) {
    gpu::Gpu gpu{{.validation = true}};
    for (const float cutoff : {0.1f, 0.5f, 0.9f}) {
        const Scene scene = cards({4}, cutoff);
        const double expected = double(texture_levels(scene.textures[0], cutoff).back().data[3]);
        if (cutoff == 0.5f) { // disks of 5 texels
            EXPECT_NEAR(expected, 3.14159265 * 25.0 / 256.0, 4e-3);
        }
        // Magnified, then from one texel a pixel down to 5; no multiples, whose samples would repeat
        // themselves.
        for (const float pixels : {251.3f, 121.7f, 93.1f, 61.3f, 47.9f, 23.3f})
            EXPECT_NEAR(seen(gpu, scene, 4, 288, pixels), expected, 0.02 * expected + 0.5 / double(pixels))
                << cutoff << " at " << pixels << " pixels";
    }
    for (const std::string& message : gpu.validation_messages()) ADD_FAILURE() << message;
}

// Behind one another they let through the product of what each does.
TEST(Masks, CardsBehindOneAnotherAreIndependent) {
    gpu::Gpu gpu{{.validation = true}};
    std::vector<float> distances;
    for (int i = 0; i < 4; ++i) distances.push_back(100.0f + float(i));
    Scene scene = cards(distances, 0.5f);
    // So many disks that none is resolved: they would lie behind one another.
    scene.materials[0].base_color_texture.transform = glm::mat3(8.0f);
    const double one = double(texture_levels(scene.textures[0], 0.5f).back().data[3]);
    EXPECT_NEAR(seen(gpu, scene, 100, 64, 48), 1.0 - std::pow(1.0 - one, 4.0), 0.03);
}

} // namespace
} // namespace luxel
