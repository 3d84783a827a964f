// SPDX-License-Identifier: MIT
// The frame on the GPU: its G-buffer against ray casting, closed forms of its light, composition and errors.
#include "techniques/frame/renderer.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/error.h"
#include "scene/environment.h"
#include "scene/lights.h"
#include "scene/procedural.h"
#include "scene/surface.h"
#include "techniques/frame/ambient_params.h"
#include "techniques/frame/compose_params.h"

namespace luxel {
namespace {

// A device whose validation messages fail the test that caused them.
class FrameTest : public ::testing::Test {
protected:
    void TearDown() override {
        for (const std::string& message : gpu.validation_messages()) ADD_FAILURE() << message;
    }
    RenderResult render(const Scene& scene, const FrameOptions& options, RenderRequest request) {
        if (request.width == 0) request.width = 160, request.height = 120;
        request.camera = scene.cameras.at(0);
        return Renderer(gpu, scene, options).render(request);
    }
    gpu::Gpu gpu{{.validation = true}};
};

// A floor of albedo 1 without specular lobe, 2 m wide, seen from above.
Scene floor_scene() {
    Scene scene;
    scene.name = "floor";
    Material m;
    m.metallic = 0.0f, m.specular = 0.0f;
    scene.materials.push_back(m);
    scene.meshes.emplace_back();
    add_quad(scene.meshes[0], {-1, 0, 1}, {2, 0, 0}, {0, 0, -2});
    scene.instances.emplace_back();
    Camera camera;
    camera.position = {0, 2, 0};
    camera.forward = {0, -1, 0};
    camera.up = {0, 0, -1};
    camera.yfov = 0.8f;
    scene.cameras.push_back(camera);
    return scene;
}

Environment uniform_environment(glm::vec3 radiance) {
    Environment e;
    e.radiance = Image(64, 32, 3);
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 64; ++x) e.radiance.set_rgb(x, y, radiance);
    return e;
}

struct GBufferError {
    double depth = 0, normal = 0, geometric = 0, albedo = 0; // means: relative, radians, radians, absolute
    int compared = 0, different = 0;                         // pixels; another surface is seen
};

GBufferError gbuffer_error(const Scene& scene, const RenderResult& frame) {
    RayCaster rays(scene);
    const Camera& camera = scene.cameras[0];
    int width = frame.mask.width, height = frame.mask.height;
    CameraBasis basis = camera_basis(camera, width, height);
    auto angle = [](glm::vec3 a, glm::vec3 b) {
        return std::asin(std::min(glm::length(glm::cross(a, b)), 1.0f));
    };
    GBufferError e;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            Ray ray{basis.position, pixel_direction(basis, width, height, glm::vec2(x, y) + 0.5f),
                    camera.near, camera.far};
            Hit hit;
            bool found = rays.intersect(ray, hit);
            float z = *frame.images.at("depth").at(x, y);
            EXPECT_EQ(*frame.mask.at(x, y), z > 0.0f ? 1.0f : 0.0f);
            if (!found && z == 0.0f) continue;
            // On an edge the rasterizer's pixel grid (1/256) may choose the other surface.
            Surface s = found ? surface_at(scene, hit, ray.direction) : Surface{};
            glm::vec3 toward_eye = s.geometric_normal * (s.front ? 1.0f : -1.0f);
            if (!found || std::abs(z - hit.t) > 0.01f * hit.t ||
                angle(frame.images.at("geometric_normal").rgb(x, y), toward_eye) > 0.1f) {
                ++e.different;
                continue;
            }
            float side = s.front ? 1.0f : -1.0f;
            ++e.compared;
            e.depth += std::abs(z - hit.t) / hit.t;
            e.normal += angle(frame.images.at("normal").rgb(x, y), s.normal * side);
            e.geometric += angle(frame.images.at("geometric_normal").rgb(x, y), toward_eye);
            e.albedo += glm::length(frame.images.at("diffuse").rgb(x, y) - s.brdf.diffuse);
        }
    e.depth /= e.compared, e.normal /= e.compared, e.geometric /= e.compared, e.albedo /= e.compared;
    return e;
}

// Half floats keep 11 bits: up to 4.9e-4 of a component below 1 where stores truncate, sqrt(3) times that of
// a vector.
TEST_F(FrameTest, GBufferEqualsRayCasting) {
    for (const Scene& scene : {cornell(), shapes(ShapesLight::point)}) {
        RenderResult frame =
            render(scene, {.mipmaps = false}, {.images = {"depth", "normal", "geometric_normal", "diffuse"}});
        GBufferError e = gbuffer_error(scene, frame);
        EXPECT_GT(e.compared, 160 * 120 / 2) << scene.name;
        EXPECT_LE(e.different, e.compared / 200) << scene.name;
        EXPECT_LT(e.depth, 1e-5) << scene.name;
        EXPECT_LT(e.normal, 1e-3) << scene.name;
        EXPECT_LT(e.geometric, 2e-3) << scene.name;
        EXPECT_LT(e.albedo, 8.5e-4) << scene.name;
    }
}

// A small texture wrapped in all ways, with holes, a vertex color and a mirrored instance; by the shader's
// own filter and by the sampler.
TEST_F(FrameTest, TexturesMasksAndMirroredInstancesEqualRayCasting) {
    Scene scene = floor_scene();
    Texture texture;
    texture.srgb = true;
    texture.pixels = {.width = 4, .height = 2, .rgba = {}};
    for (int i = 0; i < 4 * 2; ++i)
        for (int value : {i * 32, 255 - i * 20, (i * 77) % 256, i == 2 ? 0 : 255})
            texture.pixels.rgba.push_back(std::uint8_t(value));
    Mesh& mesh = scene.meshes[0];
    mesh.texcoords[0] = {{-1.3f, -0.7f}, {1.9f, -0.7f}, {1.9f, 2.2f}, {-1.3f, 2.2f}};
    mesh.colors.assign(4, glm::vec4(1.0f, 0.5f, 0.25f, 1.0f));
    scene.materials[0].base_color_texture.texture = 0;
    scene.materials[0].alpha_mode = AlphaMode::mask;
    scene.instances[0].transform[0][0] = -1.0f;
    for (Wrap u : {Wrap::repeat, Wrap::clamp, Wrap::mirror})
        for (bool nearest : {false, true})
            for (bool mipmaps : {false, true}) {
                texture.wrap_u = u, texture.wrap_v = u == Wrap::clamp ? Wrap::mirror : Wrap::clamp;
                texture.nearest = nearest;
                scene.textures = {texture};
                RenderResult frame = render(scene, {.mipmaps = mipmaps},
                                            {.images = {"depth", "normal", "geometric_normal", "diffuse"}});
                GBufferError e = gbuffer_error(scene, frame);
                EXPECT_GT(e.compared, 160 * 120 / 4);
                EXPECT_LE(e.different, e.compared / 100) << int(u) << nearest << mipmaps;
                EXPECT_LT(e.albedo, 3e-3) << int(u) << nearest << mipmaps;
                EXPECT_LT(e.normal, 1e-3);
            }
}

// A point light of intensity I at height h above a floor of albedo 1: L = I/(pi h^2) at its foot.
TEST_F(FrameTest, DirectLightMatchesTheClosedFormInEveryShadowMode) {
    Scene scene = floor_scene();
    shared::Light lamp{};
    lamp.position = {0, 1.5f, 0};
    lamp.intensity = glm::vec3(3.0f);
    scene.lights = {lamp};
    for (ShadowMode mode : {ShadowMode::hard, ShadowMode::pcf, ShadowMode::esm}) {
        RenderResult frame = render(scene, {.shadow = mode, .shadow_size = 256}, {.width = 33, .height = 33});
        EXPECT_NEAR(frame.radiance.at(16, 16)[0], 3.0f / (shared::PI * 1.5f * 1.5f), 1e-3f);
        // Nowhere does the floor shadow itself.
        for (float v : frame.radiance.data) EXPECT_GT(v, 0.1f);
    }
}

// A roof over half of the floor: no light under it, all beside it, and PCF and ESM fall without a step
// between.
TEST_F(FrameTest, ShadowsOfARoofAreDarkAndSoftAtTheBorderOnly) {
    Scene scene = floor_scene();
    scene.meshes.emplace_back();
    add_quad(scene.meshes[1], {-1, 0.2f, 1}, {1, 0, 0}, {0, 0, -2});
    scene.instances.push_back({.name = "roof", .mesh = 1});
    scene.cameras[0].position = {0, 0.15f, 0};
    shared::Light sun{};
    sun.type = shared::LIGHT_DIRECTIONAL;
    sun.direction = {0, -1, 0};
    sun.intensity = glm::vec3(shared::PI);
    scene.lights = {sun};
    for (ShadowMode mode : {ShadowMode::hard, ShadowMode::pcf, ShadowMode::esm}) {
        RenderResult frame = render(scene, {.shadow = mode, .shadow_size = 64}, {.width = 64, .height = 64});
        float before = 0.0f, steepest = 0.0f;
        for (int x = 0; x < 64; ++x) {
            float v = frame.radiance.at(x, 32)[0];
            EXPECT_GE(v, before - 1e-3f)
                << int(mode) << " at " << x; // rises from the roof's side to the open
            steepest = std::max(steepest, v - before);
            before = v;
        }
        EXPECT_LT(frame.radiance.at(0, 32)[0], 0.01f) << int(mode);
        EXPECT_NEAR(frame.radiance.at(63, 32)[0], 1.0f, 1e-3f) << int(mode);
        if (mode == ShadowMode::hard)
            EXPECT_GT(steepest, 0.99f);
        else
            EXPECT_LT(steepest, 0.6f) << int(mode);
    }
}

// More lights than one batch holds: ten times the same tenth is the whole.
TEST_F(FrameTest, BatchesOfLightsAddUp) {
    Scene scene = floor_scene();
    shared::Light lamp{};
    lamp.position = {0.3f, 1.5f, 0.2f};
    lamp.intensity = glm::vec3(3.0f);
    scene.lights = {lamp};
    RenderResult one = render(scene, {.shadow_size = 128}, {});
    lamp.intensity = glm::vec3(0.05f);
    scene.lights.assign(60, lamp);
    RenderResult many = render(scene, {.shadow_size = 128}, {});
    for (std::size_t i = 0; i < one.radiance.data.size(); ++i)
        EXPECT_NEAR(one.radiance.data[i], many.radiance.data[i], 1e-4f);
}

// An environment of radiance 1 everywhere: a floor of albedo 1 has radiance 1, ambient or as directional
// lights.
TEST_F(FrameTest, UniformEnvironmentLightsAWhiteFloorToItsRadiance) {
    Scene scene = floor_scene();
    scene.environment = uniform_environment({1.0f, 2.0f, 0.5f});
    RenderResult ambient =
        render(scene, {.environment = EnvironmentMode::ambient}, {.width = 33, .height = 33});
    EXPECT_LT(glm::length(ambient.radiance.rgb(16, 16) - glm::vec3(1.0f, 2.0f, 0.5f)), 0.01f);
    RenderResult lights =
        render(scene, {.shadow_size = 128, .environment_lights = 256}, {.width = 33, .height = 33});
    EXPECT_LT(glm::length(lights.radiance.rgb(16, 16) - glm::vec3(1.0f, 2.0f, 0.5f)), 0.05f);
}

TEST_F(FrameTest, BackgroundIsTheEnvironmentsRadiance) {
    Scene scene = floor_scene();
    scene.cameras[0].forward = glm::normalize(glm::vec3(0.3f, 0.1f, -0.8f));
    scene.cameras[0].up = {0, 1, 0};
    scene.environment.radiance = Image(16, 8, 3);
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 16; ++x) scene.environment.radiance.set_rgb(x, y, glm::vec3(x, y, x * y) * 0.1f);
    scene.environment.rotation = 0.7f;
    scene.environment.scale = 2.0f;
    RenderResult frame = render(scene, {.shadow_size = 128, .environment = EnvironmentMode::none}, {});
    CameraBasis basis = camera_basis(scene.cameras[0], 160, 120);
    int different = 0, compared = 0;
    for (int y = 0; y < 120; ++y)
        for (int x = 0; x < 160; ++x) {
            if (*frame.mask.at(x, y) > 0.0f) continue;
            glm::vec3 expected =
                evaluate(scene.environment, pixel_direction(basis, 160, 120, glm::vec2(x, y) + 0.5f));
            ++compared;
            different += glm::length(expected - frame.radiance.rgb(x, y)) > 1e-5f;
        }
    EXPECT_GT(compared, 5000);
    EXPECT_LE(different, compared / 1000); // at texel borders
}

TEST(FrameMaths, EnvironmentCoordinatesAreTheScenes) {
    Environment e = uniform_environment(glm::vec3(1));
    e.rotation = 1.1f;
    for (glm::vec3 d : {glm::vec3(1, 2, 3), glm::vec3(-1, 0.2f, -3), glm::vec3(0.1f, -5, 0.2f)}) {
        glm::vec2 uv = shared::environment_uv(d, e.rotation), expected = environment_uv(e, glm::normalize(d));
        EXPECT_NEAR(uv.x, expected.x, 1e-5f);
        EXPECT_NEAR(uv.y, expected.y, 1e-5f);
    }
}

// Irradiance of a sky that is 1 above the horizon and 0 below, on planes facing up, down and sideways: pi, 0,
// pi/2. Three bands reproduce a hemisphere to 3 % of pi [Ramamoorthi2001].
TEST(FrameMaths, ShIrradianceOfAHemisphere) {
    Environment sky;
    sky.radiance = Image(64, 32, 3);
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 64; ++x) sky.radiance.set_rgb(x, y, glm::vec3(1));
    shared::AmbientParams p{};
    std::vector<glm::vec3> sh = project_environment_sh(sky);
    std::copy(sh.begin(), sh.end(), p.sh);
    EXPECT_NEAR(shared::sh_irradiance(p, {0, 1, 0}).x, shared::PI, 0.03f * shared::PI);
    EXPECT_NEAR(shared::sh_irradiance(p, {0, -1, 0}).x, 0.0f, 0.03f * shared::PI);
    EXPECT_NEAR(shared::sh_irradiance(p, {1, 0, 0}).x, shared::PI / 2, 0.03f * shared::PI);
}

// A technique that counts its calls, for composition.
struct Constant : Technique {
    Slot where = Slot::diffuse;
    float value = 0.0f, access = 1.0f;
    int prepared = 0;
    Slot slot() const override { return where; }
    void prepare(gpu::Gpu&, const Scene&) override { ++prepared; }
    Contribution render(gpu::Recorder& recorder, const Frame& frame) override {
        Contribution c{
            recorder.image({frame.width, frame.height}, "constant"),
            recorder.image({frame.width, frame.height, VK_FORMAT_R32_SFLOAT}, "constant accessibility")};
        recorder.clear(c.radiance, {value, value, value, 1});
        recorder.clear(c.accessibility, {access, 0, 0, 0});
        return c;
    }
};

TEST_F(FrameTest, CompositionAddsContributionsAndScalesTheAmbientTerm) {
    Scene scene = floor_scene();
    scene.environment = uniform_environment(glm::vec3(1.0f));
    Constant occlusion, diffuse;
    occlusion.where = Slot::occlusion, occlusion.access = 0.25f;
    diffuse.value = 0.5f;
    Renderer renderer(gpu, scene, {.environment = EnvironmentMode::ambient});
    RenderRequest request{
        .camera = scene.cameras[0], .width = 9, .height = 9, .techniques = {&diffuse, &occlusion}};
    request.images = {"constant accessibility", "ambient"};
    request.accessibility = true;
    RenderResult frame = renderer.render(request);
    EXPECT_NEAR(frame.radiance.at(4, 4)[0], 0.25f * 1.0f + 0.5f, 0.01f);
    EXPECT_NEAR(frame.images.at("ambient").at(4, 4)[0], 1.0f, 0.01f);
    EXPECT_EQ(frame.accessibility.channels, 1);
    EXPECT_EQ(frame.accessibility.at(4, 4)[0], 0.25f);
    EXPECT_GT(frame.memory_bytes, 0u);
    EXPECT_FALSE(frame.passes.empty());

    // Prepared once for a renderer, again for another.
    renderer.render(request);
    EXPECT_EQ(diffuse.prepared, 1);
    Renderer(gpu, scene, {}).render(request);
    EXPECT_EQ(diffuse.prepared, 2);

    request.techniques.clear(), request.images.clear();
    EXPECT_TRUE(renderer.render(request).accessibility.empty());
}

// The same lights see the same samples, so that only the order of a sum differs.
TEST_F(FrameTest, SupersamplingIsTheMeanOfALargerFrame) {
    Scene scene = floor_scene();
    shared::Light lamp{};
    lamp.type = shared::LIGHT_POINT, lamp.position = {0.3f, 1.0f, 0.2f}, lamp.intensity = glm::vec3(2.0f);
    scene.lights = {lamp};
    scene.environment = uniform_environment(glm::vec3(0.25f));
    scene.cameras[0].yfov = 1.3f, scene.cameras[0].up = glm::normalize(glm::vec3(0.3f, 0.0f, -1.0f));
    const FrameOptions options{.environment = EnvironmentMode::ambient};
    const int side = 3, width = 31, height = 23;
    const RenderResult large =
        render(scene, options, {.width = side * width, .height = side * height, .images = {"depth"}});
    FrameOptions fine = options;
    fine.supersample = side;
    const RenderResult mean = render(scene, fine, {.width = width, .height = height});
    ASSERT_EQ(mean.radiance.width, width);
    int borders = 0;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            glm::vec3 sum(0.0f);
            float seen = 0.0f;
            for (int i = 0; i < side * side; ++i) {
                const int u = x * side + i % side, v = y * side + i / side;
                sum += large.radiance.rgb(u, v) / float(side * side), seen += *large.mask.at(u, v);
            }
            EXPECT_NEAR(mean.radiance.rgb(x, y).g, sum.g, 1e-5f * sum.g) << x << " " << y;
            EXPECT_EQ(*mean.mask.at(x, y), seen >= 5.0f ? 1.0f : 0.0f) << x << " " << y;
            borders += seen > 0.0f && seen < 9.0f;
        }
    EXPECT_GT(borders, 20);
}

TEST_F(FrameTest, MisuseIsAnErrorWithAReason) {
    Scene scene = floor_scene();
    Constant a, b;
    auto sentence = [&](RenderRequest request) -> std::string {
        try {
            request.camera = scene.cameras[0];
            Renderer(gpu, scene, {}).render(request);
        } catch (const Error& e) {
            EXPECT_EQ(e.fault(), Fault::usage);
            return e.what();
        }
        return "";
    };
    EXPECT_NE(sentence({.width = 8, .height = 8, .techniques = {&a, &b}}).find("diffuse"), std::string::npos);
    EXPECT_NE(sentence({.width = 8, .height = 8, .images = {"depht"}}).find("depth"), std::string::npos);
    EXPECT_NE(sentence({.width = 0, .height = 8}), "");
}

TEST(Techniques, UnknownNamesAreErrors) {
    try {
        make_technique({"no-such-technique", {}});
        FAIL();
    } catch (const Error& e) {
        EXPECT_EQ(e.fault(), Fault::usage);
        EXPECT_NE(std::string(e.what()).find("no-such-technique"), std::string::npos);
    }
    for (const TechniqueInfo& t : all_techniques()) EXPECT_EQ(make_technique({t.name, {}})->slot(), t.slot);
}

} // namespace
} // namespace luxel
