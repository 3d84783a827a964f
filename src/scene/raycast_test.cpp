// SPDX-License-Identifier: MIT
// Ray queries: orientation, masks, instances, and rooms that do not leak.
#include "scene/raycast.h"

#include <gtest/gtest.h>

#include "scene/surface.h"
#include "shared/random.h"
#include "shared/sampling.h"

namespace luxel {
namespace {

// One triangle in the plane z = 0, counter-clockwise seen from +z.
Scene one_triangle() {
    Scene scene;
    scene.materials.resize(1);
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.normals.assign(3, {0, 0, 1});
    mesh.indices = {0, 1, 2};
    scene.meshes.push_back(mesh);
    scene.instances.push_back({});
    return scene;
}

// The cube [-1, 1]^3 with shared corners.
Scene closed_cube() {
    Scene scene = one_triangle();
    Mesh& mesh = scene.meshes[0];
    mesh.positions.clear();
    for (int i = 0; i < 8; ++i) mesh.positions.push_back({i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1});
    mesh.normals = mesh.positions;
    mesh.indices = {0, 1, 3, 0, 3, 2, 4, 6, 7, 4, 7, 5, 0, 4, 5, 0, 5, 1,
                    2, 3, 7, 2, 7, 6, 0, 2, 6, 0, 6, 4, 1, 5, 7, 1, 7, 3};
    return scene;
}

TEST(RayCaster, FindsDistanceWeightsAndWinding) {
    Scene scene = one_triangle();
    RayCaster rays(scene);
    Hit hit;
    ASSERT_TRUE(rays.intersect({{0.25f, 0.5f, 2.0f}, {0, 0, -4}}, hit));
    EXPECT_FLOAT_EQ(hit.t, 0.5f); // in lengths of the direction
    EXPECT_FLOAT_EQ(hit.u, 0.25f);
    EXPECT_FLOAT_EQ(hit.v, 0.5f);
    EXPECT_EQ(hit.instance, 0u);
    EXPECT_EQ(hit.triangle, 0u);
    EXPECT_GT(hit.geometric_normal.z, 0.0f);

    ASSERT_TRUE(rays.intersect({{0.25f, 0.5f, -2.0f}, {0, 0, 1}}, hit)) << "seen from behind";
    EXPECT_GT(hit.geometric_normal.z, 0.0f);
    EXPECT_FALSE(rays.intersect({{0.25f, 0.5f, 2.0f}, {0, 0, -1}, 0.0f, 1.9f}, hit)) << "beyond t_max";
    EXPECT_TRUE(rays.occluded({{0.25f, 0.5f, 2.0f}, {0, 0, -1}, 0.0f, 2.1f}));
    EXPECT_FALSE(rays.occluded({{0.25f, 0.5f, 2.0f}, {0, 0, -1}, 2.1f, 9.0f}));
    EXPECT_FALSE(rays.occluded({{0.75f, 0.5f, 2.0f}, {0, 0, -1}}));
}

// glTF: a mirroring transform leaves the front of a surface its front.
TEST(RayCaster, MirroredInstanceKeepsItsFront) {
    Scene scene = one_triangle();
    scene.instances[0].transform[0][0] = -1.0f;
    RayCaster rays(scene);
    Hit hit;
    ASSERT_TRUE(rays.intersect({{-0.25f, 0.25f, 1.0f}, {0, 0, -1}}, hit));
    EXPECT_GT(hit.geometric_normal.z, 0.0f);
    Surface s = surface_at(scene, hit, {0, 0, -1});
    EXPECT_TRUE(s.front);
    EXPECT_NEAR(s.normal.z, 1.0f, 1e-6f);
}

TEST(RayCaster, MaskedTexelsAreHoles) {
    Scene scene = one_triangle();
    scene.textures.push_back({"half", {2, 1, {255, 255, 255, 0, 255, 255, 255, 255}, true}});
    scene.textures[0].nearest = true;
    scene.materials[0].base_color_texture.texture = 0;
    scene.materials[0].alpha_mode = AlphaMode::mask;
    scene.meshes[0].texcoords[0] = {{0, 0}, {1, 0}, {0, 1}};
    RayCaster rays(scene);
    Hit hit;
    EXPECT_FALSE(rays.intersect({{0.25f, 0.25f, 1.0f}, {0, 0, -1}}, hit));
    EXPECT_FALSE(rays.occluded({{0.25f, 0.25f, 1.0f}, {0, 0, -1}}));
    EXPECT_TRUE(rays.intersect({{0.75f, 0.125f, 1.0f}, {0, 0, -1}}, hit));
    EXPECT_TRUE(rays.occluded({{0.75f, 0.125f, 1.0f}, {0, 0, -1}}));
}

TEST(RayCaster, EachInstanceHasItsPlace) {
    Scene scene = one_triangle();
    scene.instances.push_back({"second", 0, glm::mat4(1.0f), ""});
    scene.instances[1].transform[3] = glm::vec4(10, 0, -5, 1);
    RayCaster rays(scene);
    Hit hit;
    ASSERT_TRUE(rays.intersect({{10.25f, 0.25f, 0.0f}, {0, 0, -1}}, hit));
    EXPECT_EQ(hit.instance, 1u);
    EXPECT_FLOAT_EQ(hit.t, 5.0f);
}

TEST(RayCaster, EmptySceneHitsNothing) {
    Scene scene;
    RayCaster rays(scene);
    Hit hit;
    EXPECT_FALSE(rays.intersect({{0, 0, 0}, {0, 0, -1}}, hit));
}

// Follow random walks in a closed cube far from the origin, where rounding is coarse: no ray may get out.
TEST(RayCaster, ClosedRoomDoesNotLeak) {
    Scene scene = closed_cube();
    scene.instances[0].transform[3] = glm::vec4(100, 20, -30, 1);
    RayCaster rays(scene);
    int escaped = 0;
    glm::vec3 center(100, 20, -30), origin = center, direction(0, 0, 1);
    for (shared::uint i = 0; i < 200000; ++i) {
        Hit hit;
        if (!rays.intersect({origin, direction}, hit)) {
            ++escaped;
            origin = center;
            continue;
        }
        Surface s = surface_at(scene, hit, direction);
        glm::vec3 n = s.front ? s.geometric_normal : -s.geometric_normal;
        glm::vec2 u(shared::uniform_float(shared::hash2(i, 1)), shared::uniform_float(shared::hash2(i, 2)));
        direction = shared::frame_around(n) * shared::sample_cosine_hemisphere(u);
        origin = s.position + n * s.offset;
    }
    EXPECT_EQ(escaped, 0);
}

} // namespace
} // namespace luxel
