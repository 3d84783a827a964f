// SPDX-License-Identifier: MIT
// Coverage and energy of the frame against answers known on paper.
#include <cmath>

#include <gtest/gtest.h>

#include "scene/procedural.h"
#include "techniques/frame/renderer.h"

namespace luxel {
namespace {

class FrameMaterials : public ::testing::Test {
protected:
    void TearDown() override {
        for (const std::string& message : gpu.validation_messages()) ADD_FAILURE() << message;
    }
    RenderResult render(const Scene& scene, const FrameOptions& options = {}) {
        RenderRequest request{.camera = scene.cameras.at(0), .width = 96, .height = 96};
        return Renderer(gpu, scene, options).render(request);
    }
    gpu::Gpu gpu{{.validation = true}};
};

void add(Scene& scene, const Material& material, glm::vec3 corner, glm::vec3 u, glm::vec3 v) {
    scene.materials.push_back(material);
    Mesh& mesh = scene.meshes.emplace_back();
    mesh.material = int(scene.materials.size()) - 1;
    add_quad(mesh, corner, u, v);
    scene.instances.emplace_back().mesh = int(scene.meshes.size()) - 1;
}

Material plain(glm::vec3 albedo, glm::vec3 emission = glm::vec3(0.0f)) {
    Material m;
    m.base_color = glm::vec4(albedo, 1.0f);
    m.metallic = m.specular = 0.0f;
    m.emission = emission;
    return m;
}

Material film(float alpha, glm::vec3 emission = glm::vec3(0.0f)) {
    Material m = plain(glm::vec3(0.0f), emission);
    m.base_color.a = alpha;
    m.alpha_mode = AlphaMode::blend;
    m.double_sided = true;
    return m;
}

Camera camera_at(glm::vec3 position, glm::vec3 forward, glm::vec3 up, float yfov) {
    Camera c;
    c.position = position, c.forward = forward, c.up = up, c.yfov = yfov;
    return c;
}

double mean_of(const Image& image, int channel = 0) {
    double sum = 0.0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) sum += double(image.rgb(x, y)[channel]);
    return sum / double(image.pixels());
}

// Films of coverage .3 and .6, the nearer one bright, before a board of 1.
TEST_F(FrameMaterials, BlendedLayersLieOverEachOther) {
    Scene scene;
    scene.cameras.push_back(camera_at({0, 0, 3}, {0, 0, -1}, {0, 1, 0}, 0.3f));
    add(scene, plain(glm::vec3(0), glm::vec3(1)), {-9, -9, -1}, {18, 0, 0}, {0, 18, 0});
    add(scene, film(0.3f), {-2, -2, 0}, {4, 0, 0}, {0, 4, 0});
    FrameOptions options;
    options.emitter_lights = 0;
    EXPECT_NEAR(mean_of(render(scene, options).radiance), 0.7, 1e-3);
    add(scene, film(0.6f, glm::vec3(2)), {-2, -2, 1}, {4, 0, 0}, {0, 4, 0});
    EXPECT_NEAR(mean_of(render(scene, options).radiance), 0.6 * 2.0 + 0.4 * 0.7, 2e-3);
    // Behind the board there is nothing to see.
    add(scene, film(0.9f, glm::vec3(50)), {-2, -2, -2}, {4, 0, 0}, {0, 4, 0});
    const RenderResult all = render(scene, options);
    EXPECT_NEAR(mean_of(all.radiance), 0.6 * 2.0 + 0.4 * 0.7, 2e-3);
    EXPECT_EQ(mean_of(all.mask), 1.0);
    options.blend_layers = 1;
    EXPECT_NEAR(mean_of(render(scene, options).radiance), 0.6 * 2.0 + 0.4 * 1.0, 2e-3)
        << "the farther is left out";
}

// What is blended in name only is a surface like any other, and what has no coverage is none.
TEST_F(FrameMaterials, WholeAndNoCoverageAreExact) {
    for (float alpha : {0.0f, 1.0f}) {
        Scene scene;
        scene.cameras.push_back(camera_at({0, 0, 3}, {0, 0, -1}, {0, 1, 0}, 0.3f));
        add(scene, plain(glm::vec3(0), glm::vec3(1)), {-9, -9, -1}, {18, 0, 0}, {0, 18, 0});
        add(scene, film(alpha, glm::vec3(3)), {-2, -2, 0}, {4, 0, 0}, {0, 4, 0});
        FrameOptions options;
        options.emitter_lights = 0;
        EXPECT_EQ(mean_of(render(scene, options).radiance), alpha > 0.0f ? 3.0 : 1.0);
    }
}

// The sun through a film of coverage a lights the floor with 1 - a of it.
TEST_F(FrameMaterials, BlendedSurfacesCastTheirShareOfShadow) {
    for (float alpha : {0.1f, 0.3f, 0.75f}) {
        Scene scene;
        scene.cameras.push_back(camera_at({0, 0.5f, 0}, {0, -1, 0}, {0, 0, -1}, 0.8f));
        add(scene, plain(glm::vec3(1)), {-4, 0, 4}, {8, 0, 0}, {0, 0, -8});
        add(scene, film(alpha), {-3, 1, 3}, {6, 0, 0}, {0, 0, -6});
        shared::Light sun{};
        sun.type = shared::LIGHT_DIRECTIONAL;
        sun.direction = {0, -1, 0};
        sun.intensity = glm::vec3(shared::PI);
        scene.lights.push_back(sun);
        EXPECT_NEAR(mean_of(render(scene).radiance), 1.0 - double(alpha), 0.01) << alpha;
    }
}

// White metals and dielectrics under a white sky that is some hundred lights: the mean over a smooth ball's
// pixels.
TEST_F(FrameMaterials, WhiteBallsAreWhiteUnderAWhiteSky) {
    for (float metallic : {0.0f, 1.0f}) {
        Scene scene;
        Material m;
        m.metallic = metallic, m.roughness = 1.0f;
        scene.materials.push_back(m);
        add_sphere(scene.meshes.emplace_back(), {0, 0, 0}, 1.0f, 64, 32);
        scene.instances.emplace_back();
        scene.cameras.push_back(camera_at({0, 0, 4}, {0, 0, -1}, {0, 1, 0}, 0.35f));
        scene.environment.radiance = Image(64, 32, 3, 1.0f);
        FrameOptions options;
        options.environment_lights = 512;
        options.shadow_size = 256;
        options.shadow = ShadowMode::hard;
        const double multiple = mean_of(render(scene, options).radiance);
        EXPECT_NEAR(multiple, 1.0, 0.03) << "metallic " << metallic;
        scene.brdf = BrdfModel::single;
        EXPECT_LT(mean_of(render(scene, options).radiance), metallic > 0.0f ? 0.6 : 0.99);
    }
}

} // namespace
} // namespace luxel
