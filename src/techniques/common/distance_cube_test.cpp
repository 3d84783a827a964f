// SPDX-License-Identifier: MIT
// Distance cubes against closed forms: walls, a sphere in layers, materials, the environment.
#include "techniques/common/distance_cube.h"

#include <random>

#include <gtest/gtest.h>

#include "scene/procedural.h"
#include "scene/roles.h"
#include "shared/cube.h"
#include "support/gpu.h"
#include "techniques/frame/renderer.h"

namespace luxel {
namespace {

using glm::vec3;

// A technique that captures cubes and adds nothing.
struct CubeProbe final : Technique {
    std::function<void(gpu::Recorder&, const Frame&)> capture;
    Slot slot() const override { return Slot::post; }
    Contribution render(gpu::Recorder& recorder, const Frame& frame) override {
        capture(recorder, frame);
        return {};
    }
};

class DistanceCubeTest : public testing::GpuTest {
protected:
    void run(const Scene& scene, std::function<void(gpu::Recorder&, const Frame&)> capture) {
        CubeProbe probe;
        probe.capture = std::move(capture);
        FrameOptions options;
        options.emitter_lights = 0, options.environment = EnvironmentMode::none;
        RenderRequest request{.camera = scene.cameras.at(0), .width = 8, .height = 8, .techniques = {&probe}};
        Renderer(gpu(), scene, options).render(request);
    }
    DistanceCube cube_of(const Scene& scene, const CubeRequest& request) {
        DistanceCube cube;
        run(scene, [&](gpu::Recorder& r, const Frame& f) { cube = capture_cube(r, f, request); });
        return cube;
    }
    // Calls test(direction, texel of the image) for every texel of a layer.
    template <class F> void each_texel(const gpu::Image& image, int layer, F test) {
        for (int face = 0; face < 6; ++face) {
            Image texels = gpu().read(image.mip(0).layer(std::uint32_t(layer * 6 + face)));
            for (int y = 0; y < texels.height; ++y)
                for (int x = 0; x < texels.width; ++x) {
                    glm::vec2 uv = (glm::vec2(x, y) + 0.5f) / float(texels.width);
                    test(shared::cube_direction(face, uv), texels.at(x, y));
                }
        }
    }
};

// The walls of [-1, 1]^3, each with its own emission.
vec3 wall_color(vec3 d) { return {2.0f + d.x, 2.0f + 0.7f * d.y, 2.0f + 0.5f * d.z}; }
Scene painted_room() {
    Scene scene;
    scene.name = "painted room";
    for (int face = 0; face < 6; ++face) {
        shared::CubeAxes a = shared::cube_axes(face);
        Material m;
        m.base_color = glm::vec4(0.5f, 0.4f, 0.3f, 1.0f), m.metallic = 0.0f, m.specular = 0.0f;
        m.emission = wall_color(a.forward);
        scene.materials.push_back(m);
        Mesh mesh;
        add_quad(mesh, a.forward - a.u - a.v, 2.0f * a.u, 2.0f * a.v); // normal u x v = -forward
        mesh.material = face;
        scene.meshes.push_back(mesh);
        scene.instances.push_back({.name = "wall", .mesh = face});
    }
    scene.cameras.emplace_back();
    return scene;
}

struct WallHit {
    float distance;
    vec3 axis;
};
WallHit wall_hit(vec3 from, vec3 direction) {
    WallHit nearest{1e30f, {}};
    for (int i = 0; i < 3; ++i) {
        float s = direction[i] > 0 ? 1.0f : -1.0f, t = (s - from[i]) / direction[i];
        if (t < nearest.distance) nearest.distance = t, nearest.axis = vec3(0), nearest.axis[i] = s;
    }
    nearest.distance *= glm::length(direction);
    return nearest;
}

TEST_F(DistanceCubeTest, WallsAreWhereTheyAre) {
    const vec3 o{0.3137f, -0.8941f, 0.4523f};
    DistanceCube cube = cube_of(painted_room(), {.center = o, .size = 32});
    each_texel(cube.distance, 0, [&](vec3 d, const float* texel) {
        ASSERT_NEAR(*texel / wall_hit(o, d).distance, 1.0f, 1e-5f) << d.x << " " << d.y << " " << d.z;
    });
    each_texel(cube.normal, 0, [&](vec3 d, const float* texel) {
        for (int i = 0; i < 3; ++i) ASSERT_NEAR(texel[i], -wall_hit(o, d).axis[i], 1e-3f);
        ASSERT_EQ(texel[3], 1.0f);
    });
    each_texel(cube.radiance, 0, [&](vec3 d, const float* texel) {
        for (int i = 0; i < 3; ++i) ASSERT_NEAR(texel[i], wall_color(wall_hit(o, d).axis)[i], 1e-5f);
        ASSERT_EQ(texel[3], 1.0f);
    });
    each_texel(cube.material, 0, [&](vec3, const float* texel) {
        ASSERT_NEAR(texel[1], 0.4f, 1e-3f);
        ASSERT_EQ(texel[3], 0.0f);
    });
}

TEST_F(DistanceCubeTest, SamplersFindTheSameDirections) {
    const vec3 o{-0.2f, 0.1f, 0.5f};
    DistanceCube cube = cube_of(painted_room(), {.center = o, .size = 128});
    std::vector<glm::vec4> directions;
    std::mt19937 random(1);
    std::normal_distribution<float> normal;
    for (int i = 0; i < 2000; ++i)
        directions.emplace_back(glm::normalize(vec3(normal(random), normal(random), normal(random))), 0.0f);
    gpu::Buffer in = gpu().upload(std::span<const glm::vec4>(directions), "directions");
    gpu::Buffer out = gpu().buffer(directions.size() * sizeof(glm::vec4), "found");
    gpu::Recorder recorder(gpu());
    recorder.dispatch(
        "gpu/test/cube_look.comp", {std::uint32_t(directions.size())}, gpu::Recorder::NoParams{},
        {{"Directions", in}, {"cube", cube.distance.mip(0), gpu::Sampler::linear_clamp}, {"Found", out}});
    recorder.submit();
    std::vector<glm::vec4> found = gpu().read_all<glm::vec4>(out);
    double error = 0;
    for (std::size_t i = 0; i < found.size(); ++i)
        error += std::abs(double(found[i].x) / double(wall_hit(o, vec3(directions[i])).distance) - 1.0);
    // Linear interpolation across the box's edges is off by a share of a texel there: 2 % of the texels.
    EXPECT_LT(error / double(found.size()), 5e-4);
}

TEST_F(DistanceCubeTest, MipsAreMeansAndPyramidsBounds) {
    DistanceCube cube =
        cube_of(painted_room(), {.center = {0.3f, -0.5f, 0.45f}, .size = 16, .min_max = true});
    for (std::uint32_t face = 0; face < 6; ++face) {
        Image fine = gpu().read(cube.distance.mip(0).layer(face));
        Image mean = gpu().read(cube.distance.mip(4).layer(face));
        Image extremes = gpu().read(cube.min_max.mip(4).layer(face));
        Image middle = gpu().read(cube.min_max.mip(2).layer(face));
        double sum = 0;
        for (float d : fine.data) sum += double(d);
        EXPECT_NEAR(*mean.at(0, 0), sum / 256.0, 1e-4);
        auto [least, most] = std::minmax_element(fine.data.begin(), fine.data.end());
        EXPECT_EQ(extremes.at(0, 0)[0], *least);
        EXPECT_EQ(extremes.at(0, 0)[1], *most);
        for (int y = 0; y < 16; ++y)
            for (int x = 0; x < 16; ++x) {
                ASSERT_LE(middle.at(x / 4, y / 4)[0], *fine.at(x, y));
                ASSERT_GE(middle.at(x / 4, y / 4)[1], *fine.at(x, y));
            }
    }
}

// A ball beside the center of the painted room.
const vec3 ball_center{0.5f, 0.1f, -0.2f};
constexpr float ball_radius = 0.3f;
Scene room_with_ball(const Material& material) {
    Scene scene = painted_room();
    scene.materials.push_back(material);
    Mesh mesh;
    add_sphere(mesh, ball_center, ball_radius, 128, 64);
    mesh.material = 6;
    scene.meshes.push_back(mesh);
    scene.instances.push_back({.name = "ball", .mesh = 6, .role = "dynamic ball"});
    return scene;
}

// Where a ray from the origin enters and leaves the ball; false within a texel or so of the outline.
bool ball_hits(vec3 direction, float& enters, float& leaves) {
    float b = glm::dot(ball_center, glm::normalize(direction));
    float h = b * b - glm::dot(ball_center, ball_center) + ball_radius * ball_radius;
    if (b <= 0.0f || h < 0.01f) return false;
    enters = b - std::sqrt(h), leaves = b + std::sqrt(h);
    return true;
}

TEST_F(DistanceCubeTest, ObjectsAreLeftOutOrAlone) {
    Scene scene = room_with_ball({});
    std::vector<SceneObject> balls = dynamic_objects(scene);
    DistanceCube cube =
        cube_of(scene, {.size = 32, .layers = {{all_but(scene, balls)}, {only(scene, balls)}}});
    each_texel(cube.distance, 0, [&](vec3 d, const float* texel) {
        ASSERT_NEAR(*texel / wall_hit(vec3(0), d).distance, 1.0f, 1e-5f);
    });
    int hits = 0, misses = 0;
    each_texel(cube.distance, 1, [&](vec3 d, const float* texel) {
        float enters, leaves;
        if (ball_hits(d, enters, leaves)) {
            ASSERT_NEAR(*texel, enters, 2e-3f);
            ++hits;
        } else if (glm::dot(d, ball_center) < 0.0f) {
            ASSERT_EQ(*texel, cube.background);
            ++misses;
        }
    });
    EXPECT_GT(hits, 100);
    EXPECT_GT(misses, 100);
}

TEST_F(DistanceCubeTest, LayersHoldFrontsAndBacks) {
    Scene scene = room_with_ball({});
    std::vector<bool> ball = only(scene, dynamic_objects(scene));
    for (const std::vector<CubeLayer>& layers : {peeled_layers(ball, 3), face_layers(ball)}) {
        DistanceCube cube = cube_of(scene, {.size = 32, .layers = layers});
        float enters, leaves;
        int hits = 0;
        each_texel(cube.distance, 0, [&](vec3 d, const float* texel) {
            if (!ball_hits(d, enters, leaves)) return;
            ASSERT_NEAR(*texel, enters, 2e-3f);
        });
        each_texel(cube.distance, 1, [&](vec3 d, const float* texel) {
            if (!ball_hits(d, enters, leaves)) return;
            ASSERT_NEAR(*texel, leaves, 2e-3f);
            ++hits;
        });
        // The back's normal is still the outward one.
        each_texel(cube.normal, 1, [&](vec3 d, const float* texel) {
            if (!ball_hits(d, enters, leaves)) return;
            vec3 n = (glm::normalize(d) * leaves - ball_center) / ball_radius;
            ASSERT_NEAR(glm::dot(n, vec3(texel[0], texel[1], texel[2])), 1.0f, 2e-2f);
        });
        EXPECT_GT(hits, 100);
        if (layers.size() < 3) continue;
        each_texel(cube.distance, 2, [&](vec3, const float* texel) { ASSERT_EQ(*texel, cube.background); });
    }
}

TEST_F(DistanceCubeTest, MaterialsTellReflectorsFromRefractors) {
    Material gold, glass, pane;
    gold.base_color = {1.0f, 0.75f, 0.3f, 1.0f}, gold.roughness = 0.0f;
    glass.metallic = glass.roughness = 0.0f, glass.transmission = 1.0f, glass.thin = false;
    pane = glass, pane.thin = true;
    struct Expected {
        Material material;
        vec3 f0;
        float ior;
    };
    for (const Expected& e : {Expected{gold, {1.0f, 0.75f, 0.3f}, -1.5f}, Expected{glass, vec3(0.04f), 1.5f},
                              Expected{pane, vec3(0.04f), 1.0f}}) {
        Scene scene = room_with_ball(e.material);
        DistanceCube cube = cube_of(scene, {.size = 16});
        int seen = 0;
        each_texel(cube.material, 0, [&](vec3 d, const float* texel) {
            float enters, leaves;
            if (!ball_hits(d, enters, leaves)) return;
            for (int i = 0; i < 3; ++i) ASSERT_NEAR(texel[i], e.f0[i], 1e-3f);
            ASSERT_NEAR(texel[3], e.ior, 1e-3f);
            ++seen;
        });
        EXPECT_GT(seen, 10);
    }
}

TEST_F(DistanceCubeTest, EnvironmentIsBehindEverything) {
    Scene scene = painted_room();
    scene.environment.radiance = Image(64, 32, 3);
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 64; ++x) scene.environment.radiance.set_rgb(x, y, vec3(x, y, 1) * 0.1f);
    scene.environment.rotation = 0.4f, scene.environment.scale = 2.0f;
    CubeRequest none{.size = 16, .layers = {{std::vector<bool>(6, false)}}, .background = 50.0f};
    DistanceCube cube = cube_of(scene, none);
    int differ = 0;
    each_texel(cube.radiance, 0, [&](vec3 d, const float* texel) {
        vec3 expected = evaluate(scene.environment, glm::normalize(d));
        differ += glm::length(expected - vec3(texel[0], texel[1], texel[2])) > 1e-4f;
        ASSERT_EQ(texel[3], 0.0f);
    });
    EXPECT_LT(differ, 16); // rounding at borders of the map's texels
    each_texel(cube.distance, 0, [&](vec3, const float* texel) { ASSERT_EQ(*texel, 50.0f); });
    none.light = CubeLight::diffuse;
    each_texel(cube_of(scene, none).radiance, 0,
               [&](vec3, const float* texel) { ASSERT_EQ(texel[0], 0.0f); });
}

TEST_F(DistanceCubeTest, SharedShadowMapsGiveTheLightOfACapture) {
    Scene scene = shapes(ShapesLight::point);
    const vec3 o{0.3f, 1.0f, 0.2f};
    gpu::Image alone;
    DistanceCube cube;
    run(scene, [&](gpu::Recorder& r, const Frame& f) {
        cube = capture_cube(r, f, {.center = o, .size = 32, .light = CubeLight::diffuse});
        alone =
            f.capture(r, {.view = cube_face_view(o, 3, 32, 1e-4f, 100.0f), .prefix = "one "}).direct_diffuse;
    });
    Image expected = gpu().read(alone), face = gpu().read(cube.radiance.mip(0).layer(3));
    double light = 0;
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 32; ++x)
            for (int i = 0; i < 3; ++i) {
                ASSERT_NEAR(face.at(x, y)[i], expected.at(31 - x, y)[i], 1e-3f);
                light += double(face.at(x, y)[i]);
            }
    EXPECT_GT(light, 1.0);
}

TEST_F(DistanceCubeTest, FollowsAMovedObjectWithoutPreparation) {
    Scene scene = room_with_ball({});
    CubeProbe probe;
    DistanceCube cube;
    probe.capture = [&](gpu::Recorder& r, const Frame& f) { cube = capture_cube(r, f, {.size = 16}); };
    FrameOptions options;
    options.emitter_lights = 0;
    Renderer renderer(gpu(), scene, options);
    RenderRequest request{.camera = scene.cameras.at(0), .width = 8, .height = 8, .techniques = {&probe}};
    auto nearest = [&] {
        renderer.render(request);
        float least = 1e30f;
        each_texel(cube.distance, 0, [&](vec3, const float* texel) { least = std::min(least, *texel); });
        return least;
    };
    const float at_rest = glm::length(ball_center) - ball_radius;
    EXPECT_NEAR(nearest(), at_rest, 0.01f);
    scene.instances[6].transform[3] = glm::vec4(-0.2f * ball_center, 1.0f);
    renderer.update_motion();
    EXPECT_NEAR(nearest(), 0.8f * glm::length(ball_center) - ball_radius, 0.01f);
}

} // namespace
} // namespace luxel
