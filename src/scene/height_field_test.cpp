// SPDX-License-Identifier: MIT
// Tessellated height maps: closed forms of planes, and that nothing else of a scene changes.
#include "scene/height_field.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "scene/procedural.h"
#include "scene/raycast.h"
#include "scene/surface.h"
#include "scene/validate.h"

namespace luxel {
namespace {

// A square of 2 m at y = 1 that faces up, under a map of `width` texels in a row, half a meter deep.
Scene square(const std::vector<std::uint8_t>& row) {
    Scene scene;
    Texture map;
    map.pixels.width = int(row.size()), map.pixels.height = 1;
    for (std::uint8_t v : row) map.pixels.rgba.insert(map.pixels.rgba.end(), {v, v, v, 255});
    scene.textures = {map};
    Material material;
    material.height_texture = {.texture = 0};
    material.height_scale = 0.5f;
    scene.materials = {material};
    Mesh mesh;
    add_quad(mesh, {-1, 1, 1}, {2, 0, 0}, {0, 0, -2});
    scene.meshes = {mesh};
    scene.instances = {{.name = "square"}};
    scene.cameras.emplace_back();
    return scene;
}

float height_below(const RayCaster& rays, glm::vec2 at) {
    Hit hit{};
    EXPECT_TRUE(rays.intersect({{at.x, 5, at.y}, {0, -1, 0}}, hit));
    EXPECT_GT(hit.geometric_normal.y, 0.0f);
    return 5.0f - hit.t;
}

TEST(HeightFields, LeaveOtherScenesAlone) {
    const Scene scene = cornell(), same = with_height_fields(scene);
    EXPECT_FALSE(has_height_fields(scene));
    ASSERT_EQ(same.meshes.size(), scene.meshes.size());
    EXPECT_EQ(same.meshes[3].positions, scene.meshes[3].positions);
}

TEST(HeightFields, AreWhereTheirHeightSays) {
    // 255 is the polygon itself, 0 half a meter behind.
    for (int value : {255, 51, 0}) {
        const Scene flat = with_height_fields(square({std::uint8_t(value), std::uint8_t(value)}), 0.3f);
        validate_scene(flat, "square");
        EXPECT_FALSE(has_height_fields(flat));
        const RayCaster rays(flat);
        for (glm::vec2 at : {glm::vec2(0.1f, 0.2f), glm::vec2(-0.7f, 0.63f), glm::vec2(0.99f, -0.99f)})
            EXPECT_NEAR(height_below(rays, at), 1.0f - 0.5f * (1.0f - float(value) / 255.0f), 1e-6f);
    }
}

TEST(HeightFields, FollowBilinearTexels) {
    // Four texels over two meters: between the centers of the second and third the height rises evenly.
    const Scene ramp = with_height_fields(square({0, 0, 255, 255}), 0.01f);
    const RayCaster rays(ramp);
    EXPECT_NEAR(height_below(rays, {-0.6f, 0}), 0.5f, 1e-5f);
    EXPECT_NEAR(height_below(rays, {0, 0.3f}), 0.75f, 1e-5f);
    EXPECT_NEAR(height_below(rays, {0.125f, -0.3f}), 0.875f, 1e-5f);
    EXPECT_NEAR(height_below(rays, {0.6f, 0}), 1.0f, 1e-5f);

    // Half a meter up on half a meter along: 45 degrees, also for shading, but for what the differences over
    // a texel at the vertices around reach past the centers.
    Hit hit{};
    ASSERT_TRUE(rays.intersect({{0.0005f, 5, 0.1f}, {0, -1, 0}}, hit));
    const Surface surface = surface_at(ramp, hit, {0, -1, 0});
    EXPECT_LT(glm::length(surface.normal - glm::normalize(glm::vec3(-1, 1, 0))), 0.01f);
}

TEST(HeightFields, HaveNoCracks) {
    // Neighbors that divide their edge at the same places do so at the same bits; rays on the diagonal hit.
    Scene scene = relief();
    const Scene detailed = with_height_fields(scene, 0.1f);
    const RayCaster rays(detailed);
    for (int i = 0; i <= 1000; ++i) {
        const float s = -1.15f + 1.9f * float(i) / 1000.0f;
        Hit hit{};
        EXPECT_TRUE(rays.intersect({{s, 3, 0.4f - s}, {0, -1, 0}}, hit)) << s;
        EXPECT_LT(3.0f - hit.t, 0.41f);
        EXPECT_GT(3.0f - hit.t, -0.0501f);
    }
}

TEST(HeightFields, KeepFrontsUnderEveryTransform) {
    // Mirrored, turned and stretched; meters stay meters.
    Scene scene = square({51, 51});
    glm::mat4 transform(0.0f);
    transform[0] = {0, 0, -3, 0}, transform[1] = {0, 2, 0, 0}, transform[2] = {-1, 0, 0, 0};
    transform[3] = {0, 0, 0, 1};
    for (bool mirrored : {false, true}) {
        scene.instances[0].transform = transform;
        if (mirrored) scene.instances[0].transform[2] = {1, 0, 0, 0};
        const Scene flat = with_height_fields(scene, 0.5f);
        const RayCaster rays(flat);
        EXPECT_NEAR(height_below(rays, {0.2f, -0.3f}), 2.0f - 0.4f, 1e-6f);
        EXPECT_EQ(flat.instances[0].transform, glm::mat4(1.0f));
    }
}

TEST(HeightFields, DefaultToTrianglesOfATexel) {
    // 8 texels each way make 8 x 8 squares, 2 triangles each.
    Scene scene = square({0, 0, 255, 255, 0, 0, 255, 255});
    scene.textures[0].pixels.height = 8;
    const auto row = scene.textures[0].pixels.rgba;
    for (int i = 1; i < 8; ++i)
        scene.textures[0].pixels.rgba.insert(scene.textures[0].pixels.rgba.end(), row.begin(), row.end());
    EXPECT_EQ(with_height_fields(scene).triangles(), 128u);
}

TEST(HeightFields, AreBounded) {
    try {
        with_height_fields(square({0, 255}), 1e-5f);
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.fault(), Fault::resource);
        EXPECT_NE(std::string(error.what()).find("square"), std::string::npos);
    }
}

TEST(HeightFields, AreValidated) {
    const auto expect_error = [](Scene scene, const char* reason) {
        try {
            validate_scene(scene, "scene");
            ADD_FAILURE() << reason;
        } catch (const Error& error) {
            EXPECT_NE(std::string(error.what()).find(reason), std::string::npos) << error.what();
        }
    };
    Scene scene = square({0, 255});
    validate_scene(scene, "scene");
    scene.textures[0].nearest = true;
    expect_error(scene, "interpolated");
    scene.textures[0].nearest = false;
    scene.materials[0].height_scale = -1.0f;
    expect_error(scene, "negative");
    scene.materials[0].height_scale = 1.0f;
    scene.meshes[0].texcoords[0].clear();
    expect_error(scene, "texture coordinates");
}

} // namespace
} // namespace luxel
