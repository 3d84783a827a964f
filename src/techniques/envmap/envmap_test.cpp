// SPDX-License-Identifier: MIT
// Diffuse environment mapping against closed forms: boxes of uniform walls, and what belongs to no object.
#include "techniques/envmap/envmap.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/error.h"
#include "scene/procedural.h"
#include "shared/brdf.h"
#include "shared/sampling.h"
#include "support/glowing_room.h"
#include "support/gpu.h"
#include "techniques/frame/projection.h"
#include "techniques/frame/renderer.h"

namespace luxel {
namespace {

using glm::vec3;
using namespace testing;

constexpr int size = 64;

class EnvmapTest : public GpuTest {
protected:
    // One technique on one scene, whose instances may move between frames.
    struct Session {
        std::unique_ptr<Renderer> renderer;
        std::unique_ptr<Technique> technique;
        RenderRequest request;
        RenderResult frame() { return renderer->render(request); }
        // The technique's own light.
        Image light() { return frame().images.at("envmap radiance"); }
    };
    Session session(const Scene& scene, const std::string& parameters, std::size_t camera = 0) {
        FrameOptions options;
        options.emitter_lights = 0, options.environment = EnvironmentMode::none;
        Session s{std::make_unique<Renderer>(gpu(), scene, options),
                  make_technique(parse_specification("envmap:" + parameters)),
                  {}};
        s.request = {.camera = scene.cameras.at(camera),
                     .width = size,
                     .height = size,
                     .techniques = {s.technique.get()},
                     .images = {"envmap radiance", "depth", "normal"}};
        return s;
    }
};

TEST_F(EnvmapTest, FormFactorOnTheGpuIsTheClosedForm) {
    std::vector<glm::vec4> quads, receivers;
    for (int face = 0; face < 6; ++face) {
        shared::Quad q = wall_quad(face, 1, 0, 0, vec3(0));
        for (vec3 corner : {q.a, q.b, q.c, q.d}) quads.emplace_back(corner, float(wall_radiance[face]));
    }
    std::mt19937 random(11);
    std::vector<double> expected;
    for (int i = 0; i < 1000; ++i) {
        BoxReceiver r = random_receiver(random);
        receivers.emplace_back(r.position, 0.0f), receivers.emplace_back(r.normal, 0.0f);
        double sum = 0;
        for (int face = 0; face < 6; ++face)
            sum += wall_radiance[face] * lambert_irradiance(wall_quad(face, 1, 0, 0, r.position), r.normal);
        expected.push_back(sum);
    }
    gpu::Buffer found = gpu().buffer(expected.size() * sizeof(float), "found");
    gpu::Recorder recorder(gpu());
    recorder.dispatch("envmap/test/form_factor.comp", {1000}, gpu::Recorder::NoParams{},
                      {{"Quads", gpu().upload(std::span<const glm::vec4>(quads), "quads")},
                       {"Receivers", gpu().upload(std::span<const glm::vec4>(receivers), "receivers")},
                       {"Found", found}});
    recorder.submit();
    std::vector<float> values = gpu().read_all<float>(found);
    for (std::size_t i = 0; i < values.size(); ++i)
        ASSERT_NEAR(double(values[i]) / expected[i], 1.0, 1e-3) << i;
}

// A ball of albedo .8 within walls of radiance 1.
Scene ball_in_furnace() {
    Scene scene = ball_room(BallPlace::corner, 0.1f, BallLight::walls);
    for (int wall = 0; wall < 6; ++wall) scene.materials[std::size_t(wall)].emission = vec3(1.0f);
    return scene;
}

struct Spread {
    float least = 1e30f, most = -1e30f;
};
// Of one channel over the pixels that the technique lights.
Spread spread_of(const Image& light) {
    Spread s;
    for (int y = 0; y < light.height; ++y)
        for (int x = 0; x < light.width; ++x)
            if (float v = light.at(x, y)[0]; v > 0.0f)
                s.least = std::min(s.least, v), s.most = std::max(s.most, v);
    return s;
}

TEST_F(EnvmapTest, ClosedRoomOfRadianceOneGivesOne) {
    Scene scene = ball_in_furnace();
    for (std::size_t camera : {0u, 1u})
        for (const char* parameters :
             {"light=all,texels=2", "light=all,texels=4", "light=all,texels=8",
              "light=all,corner=averaged,radiance=corners", "light=all,estimator=classic"}) {
            Spread s = spread_of(session(scene, parameters, camera).light());
            EXPECT_NEAR(s.least, 0.8f, 4e-3f) << parameters;
            EXPECT_NEAR(s.most, 0.8f, 4e-3f) << parameters;
        }
    EXPECT_GT(spread_of(session(scene, "light=all,horizon=thesis").light()).least, 1.6f);
}

// A metal ball of that roughness instead of the diffuse one.
void make_glossy(Scene& scene, float roughness) {
    for (const Instance& instance : scene.instances)
        if (instance.role.starts_with("dynamic")) {
            Material& m = scene.materials[std::size_t(scene.meshes[std::size_t(instance.mesh)].material)];
            m.base_color = glm::vec4(0.9f, 0.6f, 0.3f, 1.0f), m.metallic = 1.0f, m.roughness = roughness;
        }
}

// Light of radiance 1 all around leaves a rough metal as its lobe's reflectance, which depends on the view.
TEST_F(EnvmapTest, GlossyBallInAFurnaceShowsItsReflectance) {
    for (const float roughness : {0.15f, 0.4f, 0.75f, 1.0f}) {
        Scene scene = ball_in_furnace();
        make_glossy(scene, roughness);
        const RenderResult result = session(scene, "light=all,glossy=on").frame();
        const shared::ViewParams view = view_params(scene.cameras[0], size, size);
        const Image &light = result.images.at("envmap radiance"), &normal = result.images.at("normal"),
                    &depth = result.images.at("depth");
        int seen = 0;
        for (int y = 0; y < size; ++y)
            for (int x = 0; x < size; ++x) {
                if (light.at(x, y)[3] == 0.0f) continue;
                const vec3 n = glm::normalize(normal.rgb(x, y));
                const vec3 wo = glm::normalize(view.position -
                                               world_position(view, glm::vec2(x, y) + 0.5f, *depth.at(x, y)));
                if (glm::dot(n, wo) < 0.1f) continue;
                const shared::Brdf b = shared::make_brdf_toward(glm::dot(n, wo), vec3(0.9f, 0.6f, 0.3f), 1,
                                                                roughness, 1.5f, 1, vec3(1));
                const glm::mat3 frame = shared::frame_around(n);
                vec3 expected(0);
                constexpr std::uint32_t count = 4096;
                for (std::uint32_t i = 0; i < count; ++i) {
                    const vec3 h = frame * shared::sample_visible_normal(wo * frame, b.alpha,
                                                                         shared::hammersley(i, count));
                    const vec3 wi = glm::reflect(-wo, h);
                    const float pdf =
                        shared::ggx_reflection_pdf(shared::ggx_d(n, h, b.alpha), glm::dot(n, wo), b.alpha);
                    expected +=
                        shared::evaluate_specular(b, n, wo, wi) * (std::max(glm::dot(n, wi), 0.0f) / pdf);
                }
                expected /= float(count), ++seen;
                for (int c = 0; c < 3; ++c)
                    EXPECT_NEAR(light.at(x, y)[c], expected[c], 0.01f) << roughness << " " << x << " " << y;
            }
        EXPECT_GT(seen, 50);
    }
}

TEST_F(EnvmapTest, PolygonsStayBoundedNearWallsAndPointsDoNot) {
    // Six colors of walls, the ball from one diameter to a fiftieth away from one, two or three of them.
    Errors polygon, point;
    for (BallPlace place : {BallPlace::face, BallPlace::edge, BallPlace::corner})
        for (float distance : {1.0f, 0.2f, 0.02f})
            for (std::size_t camera : {0u, 1u}) {
                Scene scene = ball_room(place, distance, BallLight::walls);
                auto run = [&](const std::string& parameters, Errors& worst) {
                    Errors e = errors_in_glowing_room(
                        scene, session(scene, "light=all," + parameters, camera).frame(), camera);
                    worst.rms = std::max(worst.rms, e.rms), worst.most = std::max(worst.most, e.most);
                };
                run("estimator=polygon", polygon);
                run("estimator=point", point);
            }
    EXPECT_LT(polygon.rms, 0.08);
    EXPECT_GT(point.rms, 10 * polygon.rms);
    EXPECT_GT(point.most, 10 * polygon.most);
}

TEST_F(EnvmapTest, FollowsAMovedObjectWithoutPreparation) {
    Scene scene = ball_room(BallPlace::face, 1.0f, BallLight::walls);
    Session s = session(scene, "light=all");
    const Image before = s.light();
    scene.instances[6].transform[3] = glm::vec4(-0.6f, 0.3f, 0.2f, 1.0f);
    s.renderer->update_motion();
    const RenderResult after = s.frame();
    EXPECT_NE(before.data, after.images.at("envmap radiance").data);
    EXPECT_LT(errors_in_glowing_room(scene, after, 0).rms, 0.08);
    // Back where it was, it looks as it did.
    scene.instances[6].transform = glm::mat4(1.0f);
    s.renderer->update_motion();
    EXPECT_EQ(before.data, s.light().data);
}

TEST_F(EnvmapTest, ObjectsLightEachOtherButNotThemselves) {
    // Two glowing balls and nothing else.
    Scene scene;
    for (int i = 0; i < 2; ++i) {
        Material m;
        m.base_color = glm::vec4(0.5f, 0.5f, 0.5f, 1.0f), m.metallic = 0.0f, m.specular = 0.0f;
        m.emission = i == 0 ? vec3(1, 0, 0) : vec3(0, 1, 0);
        scene.materials.push_back(m);
        Mesh mesh;
        add_sphere(mesh, {i == 0 ? -1.0f : 1.0f, 0, 0}, 0.5f, 48, 24);
        mesh.material = i;
        scene.meshes.push_back(mesh);
        scene.instances.push_back(
            {.name = "ball", .mesh = i, .role = i == 0 ? "dynamic left" : "dynamic right"});
    }
    Camera camera;
    camera.position = {0, 0, 4};
    scene.cameras.push_back(camera);
    Image light = session(scene, "light=all,size=64,texels=8").light();
    vec3 left(0), right(0);
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) (x < size / 2 ? left : right) += light.rgb(x, y);
    EXPECT_EQ(left.r, 0.0f);
    EXPECT_GT(left.g, 0.1f);
    EXPECT_EQ(right.g, 0.0f);
    EXPECT_NEAR(right.r / left.g, 1.0f, 0.02f);
}

TEST_F(EnvmapTest, LightsReliefsWhereTheyAre) {
    Scene scene = relief();
    for (Instance& instance : scene.instances) instance.role = "dynamic ground";
    Session s = session(scene, "size=16,texels=2");
    auto surface = make_technique(parse_specification("relief"));
    s.request.techniques.push_back(surface.get());
    const RenderResult result = s.frame();
    int seen = 0, missing = 0;
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x)
            if (*result.images.at("depth").at(x, y) > 0.0f)
                ++seen, missing += result.images.at("envmap radiance").at(x, y)[3] == 0.0f;
    EXPECT_GT(seen, 1000);
    EXPECT_LT(missing, seen / 100);
}

TEST_F(EnvmapTest, LightsObjectsOnlyUnlessThereIsAGrid) {
    Scene scene = sphere_in_box(); // without roles
    EXPECT_EQ(spread_of(session(scene, "size=16").light()).most, -1e30f);
    Image light = session(scene, "probes=grid,grid=3,size=16,texels=2").light();
    int lit = 0;
    for (int i = 0; i < size * size; ++i) lit += light.at(i % size, i / size)[0] > 1e-4f;
    EXPECT_GT(lit, size * size / 2);
}

TEST_F(EnvmapTest, GridLightsTheWallsOfAClosedRoom) {
    // Radiance 1 everywhere, albedo .5; on each wall itself the polygons of that wall send nothing.
    Scene scene = furnace(0.5f);
    scene.cameras[0].position = {0.7f, 0.5f, 0.8f};
    for (const char* parameters :
         {"light=all,probes=grid,grid=2,size=64", "light=all,probes=grid,grid=2,size=64,estimator=classic"}) {
        Image light = session(scene, parameters).light();
        double sum = 0;
        for (int i = 0; i < size * size; ++i) sum += double(light.at(i % size, i / size)[0]);
        EXPECT_NEAR(sum / (size * size), 0.5, 0.01) << parameters;
    }
}

TEST_F(EnvmapTest, SizesMustBePowersOfTwo) {
    Scene scene = sphere_in_box();
    EXPECT_THROW(session(scene, "texels=3").frame(), Error);
    EXPECT_THROW(session(scene, "size=100").frame(), Error);
    EXPECT_THROW(session(scene, "glossy=on,probes=grid").frame(), Error);
}

} // namespace
} // namespace luxel
