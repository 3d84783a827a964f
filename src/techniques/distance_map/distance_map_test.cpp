// SPDX-License-Identifier: MIT
// Spheres in a box of glowing walls, whose every path is known: mirror and glass, by depth and by search.
#include "techniques/distance_map/distance_map.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "scene/procedural.h"
#include "scene/procedural_parts.h"
#include "shared/brdf.h"
#include "shared/cube.h"
#include "support/gpu.h"
#include "techniques/frame/renderer.h"

namespace luxel {
namespace {

using glm::vec3;

constexpr int side = 96;
constexpr float sphere_radius = 0.4f;

vec3 wall_color(vec3 axis) { return {2.0f + axis.x, 2.0f + 0.7f * axis.y, 2.0f + 0.5f * axis.z}; }

// The walls of [-1, 1]^3, black but for their own light, and what is in between.
Scene glowing_room() {
    Scene scene;
    scene.name = "glowing room";
    for (int face = 0; face < 6; ++face) {
        const shared::CubeAxes a = shared::cube_axes(face);
        Material m;
        m.base_color = glm::vec4(0, 0, 0, 1), m.metallic = 0.0f, m.specular = 0.0f;
        m.emission = wall_color(a.forward);
        scene.materials.push_back(m);
        Mesh mesh;
        add_quad(mesh, a.forward - a.u - a.v, 2.0f * a.u, 2.0f * a.v);
        mesh.material = face;
        scene.meshes.push_back(mesh);
        scene.instances.push_back({.name = "wall", .mesh = face});
    }
    scene.cameras.push_back({.position = {0.1f, 0.2f, 0.97f}, .forward = {0, -0.1f, -1}, .yfov = 1.2f});
    scene.cameras[0].forward = glm::normalize(scene.cameras[0].forward);
    return scene;
}

Scene room_with_sphere(const Material& material) {
    Scene scene = glowing_room();
    add_sphere(procedural::add_specular_object(scene, material), vec3(0), sphere_radius, 128, 64);
    return scene;
}

vec3 wall_at(vec3 x, vec3 r) {
    float nearest = 1e30f;
    vec3 axis(0);
    for (int i = 0; i < 3; ++i) {
        const float s = r[i] > 0 ? 1.0f : -1.0f, t = (s - x[i]) / r[i];
        if (t < nearest) nearest = t, axis = vec3(0), axis[i] = s;
    }
    return wall_color(axis);
}

// Radiance along a ray in the room with the sphere, up to `depth` specular surfaces. ior 0: mirror of
// reflectance .9.
vec3 exact(vec3 x, vec3 r, float ior, int depth, bool inside) {
    const float b = glm::dot(x, r), c = glm::dot(x, x) - sphere_radius * sphere_radius;
    const float d = b * b - c;
    const float t = inside ? -b + std::sqrt(std::max(d, 0.0f)) : -b - std::sqrt(std::max(d, 0.0f));
    if (!inside && (d <= 0.0f || t < 1e-4f)) return wall_at(x, r);
    if (depth == 0) return vec3(0);
    const vec3 p = x + r * t, n = glm::normalize(p) * (inside ? -1.0f : 1.0f);
    const float cosine = -glm::dot(n, r);
    const vec3 mirrored = glm::reflect(r, n);
    if (ior == 0.0f)
        return shared::fresnel_schlick(vec3(0.9f), vec3(1), cosine) *
               exact(p, mirrored, ior, depth - 1, false);
    const float eta = inside ? 1.0f / ior : ior, fresnel = shared::fresnel_dielectric(cosine, eta);
    vec3 sum = fresnel * exact(p, mirrored, ior, depth - 1, inside);
    if (fresnel < 1.0f)
        sum += (1.0f - fresnel) / (eta * eta) *
               exact(p, glm::refract(r, n, 1.0f / eta), ior, depth - 1, !inside);
    return sum;
}

class DistanceMapTest : public testing::GpuTest {
protected:
    Image render(const Scene& scene, const std::string& parameters) {
        FrameOptions options;
        options.emitter_lights = 0, options.environment = EnvironmentMode::none;
        auto technique = make_technique(parse_specification("distance_map:" + parameters));
        RenderRequest request{
            .camera = scene.cameras.at(0), .width = side, .height = side, .techniques = {technique.get()}};
        return Renderer(gpu(), scene, options).render(request).radiance;
    }
    // Share of the sphere's pixels, away from its outline, that are off by more than 4 %.
    double wrong(float ior, int depth, const std::string& parameters) {
        const Scene scene = room_with_sphere(ior == 0.0f ? procedural::mirror("sphere", vec3(0.9f))
                                                         : procedural::glass("sphere", ior));
        const Image image = render(scene, parameters + ",least_weight=0,depth=" + std::to_string(depth));
        const CameraBasis basis = camera_basis(scene.cameras[0], side, side);
        double bad = 0, all = 0;
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x) {
                const vec3 r =
                    glm::normalize(pixel_direction(basis, side, side, {float(x) + 0.5f, float(y) + 0.5f}));
                const float b = glm::dot(basis.position, r);
                if (glm::dot(basis.position, basis.position) - b * b > 0.95f * sphere_radius * sphere_radius)
                    continue;
                const vec3 truth = exact(basis.position, r, ior, depth, false);
                ++all, bad += glm::length(image.rgb(x, y) - truth) > 0.04f * glm::length(truth) + 1e-3f;
            }
        EXPECT_GT(all, 1000);
        return bad / all;
    }
};

// What is off lies on the pictures of the room's edges.
TEST_F(DistanceMapTest, MirrorSphereShowsTheRoom) {
    EXPECT_LT(wrong(0.0f, 1, "size=128"), 0.02);
    EXPECT_LT(wrong(0.0f, 1, "size=128,search=binary,refine=8"), 0.02);
    const double direction = wrong(0.0f, 1, "size=128,search=none"),
                 parallax = wrong(0.0f, 1, "size=128,search=parallax");
    EXPECT_GT(direction, 0.1);
    EXPECT_LT(parallax, 0.7 * direction);
}

TEST_F(DistanceMapTest, GlassSphereRefractsTwiceAndMore) {
    EXPECT_LT(wrong(1.5f, 2, "size=128"), 0.04);
    EXPECT_LT(wrong(1.5f, 4, "size=128"), 0.05);
    EXPECT_LT(wrong(1.5f, 4, "size=128,near=faces"), 0.05);
    EXPECT_GT(wrong(1.5f, 4, "size=128,both=off"), 0.1); // drops energy
}

// Light of one color all around: whatever the path, nothing is lost or added.
TEST_F(DistanceMapTest, FurnaceOfGlassIsInvisible) {
    Scene scene = room_with_sphere(procedural::glass("sphere", 1.5f));
    for (int i = 0; i < 6; ++i) scene.materials[std::size_t(i)].emission = vec3(1);
    const Image image = render(scene, "size=128,least_weight=0.0001,depth=8");
    for (int y = side / 2 - 12; y < side / 2 + 12; ++y)
        for (int x = side / 2 - 12; x < side / 2 + 12; ++x)
            EXPECT_NEAR(image.rgb(x, y).g, 1.0f, 0.01f) << x << " " << y;
}

// A mirror that sees a second one, each with a map of its own: the depth bounds the path.
TEST_F(DistanceMapTest, MirrorsSeeEachOther) {
    Scene scene = glowing_room();
    const Material metal = procedural::mirror("sphere", vec3(0.9f));
    add_sphere(procedural::add_specular_object(scene, metal), {-0.45f, 0, 0}, 0.3f, 64, 32);
    add_sphere(procedural::add_specular_object(scene, metal), {0.45f, 0, 0}, 0.3f, 64, 32);
    scene.instances[6].role = "specular left", scene.instances[7].role = "specular right";
    const Image once = render(scene, "size=128,depth=1"), deep = render(scene, "size=128,depth=8");
    double black = 0, darker = 0;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            black += once.rgb(x, y).g == 0.0f && deep.rgb(x, y).g > 0.5f;
            darker += deep.rgb(x, y).g < once.rgb(x, y).g - 0.2f;
        }
    EXPECT_GT(black, 40);
    EXPECT_LT(darker, 10);
}

// A room without its front: rays that leave through the opening show the environment, not what the sphere's
// center sees in their direction.
TEST_F(DistanceMapTest, RaysThatLeaveShowTheEnvironment) {
    Scene scene = room_with_sphere(procedural::mirror("sphere", vec3(0.9f)));
    std::erase_if(scene.instances, [](const Instance& i) { return i.mesh == 4; }); // +z
    scene.environment.radiance = Image(8, 4, 3, 9.0f);
    const Image image = render(scene, "size=128,depth=1");
    const CameraBasis basis = camera_basis(scene.cameras[0], side, side);
    int left = 0, wrong = 0;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const vec3 r =
                glm::normalize(pixel_direction(basis, side, side, {float(x) + 0.5f, float(y) + 0.5f}));
            const float b = glm::dot(basis.position, r);
            const float d = b * b - glm::dot(basis.position, basis.position) + sphere_radius * sphere_radius;
            if (d <= 0.05f * sphere_radius * sphere_radius) continue;
            const vec3 p = basis.position + r * (-b - std::sqrt(d)), n = glm::normalize(p);
            const vec3 away = glm::reflect(r, n), out = p + away * ((1.0f - p.z) / away.z);
            if (away.z <= 0.0f || std::max(std::abs(out.x), std::abs(out.y)) > 0.98f) continue;
            const vec3 truth = 9.0f * shared::fresnel_schlick(vec3(0.9f), vec3(1), -glm::dot(r, n));
            ++left, wrong += glm::length(image.rgb(x, y) - truth) > 0.01f * glm::length(truth);
        }
    EXPECT_GT(left, 300);
    EXPECT_LT(wrong, 0.03 * left); // those at the opening's rim, by a texel
}

// Four rows of seven mirrors: sixteen cubes, none of which spans two rows.
TEST_F(DistanceMapTest, ManyMirrorsShareCubesWithTheirNeighbors) {
    std::vector<Bounds> boxes;
    for (int row = 0; row < 4; ++row)
        for (int i = 0; i < 7; ++i) {
            Bounds b;
            b.add(vec3(float(i), 0, 20.0f * float(row))), b.add(vec3(float(i) + 0.5f, 1, 20.0f * float(row)));
            boxes.push_back(b);
        }
    const std::vector<Bounds> groups = group_boxes(boxes, 16);
    EXPECT_EQ(groups.size(), 16u);
    for (const Bounds& g : groups) EXPECT_LT(g.most.z - g.least.z, 1.0f);

    Scene scene = glowing_room();
    Material metal = procedural::mirror("sphere", vec3(0.9f));
    for (int i = 0; i < 17; ++i) {
        add_sphere(procedural::add_object(scene, metal), {0.1f * float(i) - 0.8f, 0, 0}, 0.04f, 8, 6);
    }
    auto technique = make_technique(parse_specification("distance_map:size=16"));
    RenderRequest request{
        .camera = scene.cameras.at(0), .width = 8, .height = 8, .techniques = {technique.get()}};
    const RenderResult result = Renderer(gpu(), scene, {.emitter_lights = 0}).render(request);
    ASSERT_EQ(result.warnings.size(), 1u);
    EXPECT_NE(result.warnings[0].find("17 specular objects"), std::string::npos) << result.warnings[0];
}

TEST_F(DistanceMapTest, ASceneWithoutSpecularObjectsGetsNothing) {
    const Image image = render(glowing_room(), "size=16");
    EXPECT_NEAR(image.rgb(side / 2, side / 2).r, 2.0f, 1e-3f);
}

} // namespace
} // namespace luxel
