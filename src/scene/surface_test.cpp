// SPDX-License-Identifier: MIT
// Interpolation, texture filtering and tangent frames at a hit.
#include "scene/surface.h"

#include <gtest/gtest.h>

#include "scene/shading_mesh.h"

namespace luxel {
namespace {

// 2x1 texture: black left, white right.
Texture black_white(bool srgb) {
    Texture t;
    t.pixels = {2, 1, {0, 0, 0, 255, 255, 255, 255, 255}, false};
    t.srgb = srgb;
    return t;
}

Scene textured_triangle() {
    Scene scene;
    scene.materials.resize(1);
    scene.materials[0].metallic = 0.0f;
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.normals.assign(3, {0, 0, 1});
    mesh.tangents.assign(3, {1, 0, 0, 1});
    mesh.texcoords[0] = {{0, 0}, {1, 0}, {0, 1}};
    mesh.indices = {0, 1, 2};
    scene.meshes.push_back(mesh);
    scene.instances.push_back({});
    return scene;
}

Surface look(const Scene& scene, glm::vec3 origin, glm::vec3 direction) {
    RayCaster rays(scene);
    Hit hit;
    EXPECT_TRUE(rays.intersect({origin, direction}, hit));
    return surface_at(scene, hit, direction);
}

TEST(SampleTexture, TexelCentersAreExactAndBetweenIsLinear) {
    Texture t = black_white(false);
    EXPECT_FLOAT_EQ(sample_texture(t, {0.25f, 0.5f}).r, 0.0f);
    EXPECT_FLOAT_EQ(sample_texture(t, {0.75f, 0.5f}).r, 1.0f);
    EXPECT_FLOAT_EQ(sample_texture(t, {0.5f, 0.1f}).r, 0.5f);
    EXPECT_FLOAT_EQ(sample_texture(t, {0.625f, 0.9f}).r, 0.75f);
}

TEST(SampleTexture, WrapsAsAsked) {
    Texture t = black_white(false);
    EXPECT_FLOAT_EQ(sample_texture(t, {0.0f, 0.5f}).r, 0.5f) << "half of the texel at the other end";
    EXPECT_FLOAT_EQ(sample_texture(t, {-2.25f, 0.5f}).r, 1.0f);
    EXPECT_FLOAT_EQ(sample_texture(t, {1.0f, 0.5f}).r, 0.5f);
    t.wrap_u = Wrap::clamp;
    EXPECT_FLOAT_EQ(sample_texture(t, {0.0f, 0.5f}).r, 0.0f);
    EXPECT_FLOAT_EQ(sample_texture(t, {7.0f, 0.5f}).r, 1.0f);
    t.wrap_u = Wrap::mirror;
    EXPECT_FLOAT_EQ(sample_texture(t, {1.0f, 0.5f}).r, 1.0f);
    EXPECT_FLOAT_EQ(sample_texture(t, {1.75f, 0.5f}).r, 0.0f);
    EXPECT_FLOAT_EQ(sample_texture(t, {-0.75f, 0.5f}).r, 1.0f);
}

// The sRGB curve is undone before filtering: the middle of black and white is half the light.
TEST(SampleTexture, DecodesBeforeFiltering) {
    Texture t = black_white(true);
    EXPECT_FLOAT_EQ(sample_texture(t, {0.5f, 0.5f}).r, 0.5f);
    t.pixels.rgba = {128, 128, 128, 128, 128, 128, 128, 128};
    EXPECT_NEAR(sample_texture(t, {0.3f, 0.5f}).g, 0.215861f, 1e-5f);
    EXPECT_NEAR(sample_texture(t, {0.3f, 0.5f}).a, 128.0f / 255.0f, 1e-6f) << "alpha is never encoded";
}

TEST(SampleTexture, NearestTakesTheTexelThatHoldsThePoint) {
    Texture t = black_white(false);
    t.nearest = true;
    EXPECT_EQ(sample_texture(t, {0.49f, 0.5f}).r, 0.0f);
    EXPECT_EQ(sample_texture(t, {0.51f, 0.5f}).r, 1.0f);
    EXPECT_EQ(sample_texture(t, {0.99f, 0.5f}).r, 1.0f);
    EXPECT_EQ(sample_texture(t, {-0.01f, 0.5f}).r, 1.0f);
}

TEST(Surface, InterpolatesColorAndTransformsTexcoords) {
    Scene scene = textured_triangle();
    scene.meshes[0].colors = {{1, 0, 0, 1}, {0, 1, 0, 1}, {0, 0, 1, 1}};
    Surface s = look(scene, {0.25f, 0.5f, 1.0f}, {0, 0, -1});
    EXPECT_NEAR(s.base_color.r, 0.25f, 1e-6f);
    EXPECT_NEAR(s.base_color.g, 0.25f, 1e-6f);
    EXPECT_NEAR(s.base_color.b, 0.5f, 1e-6f);
    EXPECT_NEAR(glm::length(s.position - glm::vec3(0.25f, 0.5f, 0.0f)), 0.0f, 4.0f * s.offset);

    scene.meshes[0].colors.clear();
    scene.textures.push_back(black_white(false));
    scene.materials[0].base_color_texture.texture = 0;
    scene.materials[0].base_color_texture.transform[2] = glm::vec3(0.375f, 0, 1); // u + .375
    EXPECT_NEAR(look(scene, {0.25f, 0.5f, 1.0f}, {0, 0, -1}).base_color.r, 0.75f, 1e-5f);
}

// Normals follow the inverse transpose: squashing a 45 degree slope to a tenth of its height flattens it.
TEST(Surface, NormalsFollowTheInverseTranspose) {
    Scene scene = textured_triangle();
    scene.meshes[0].positions = {{0, 0, 0}, {1, 0, -1}, {0, 1, 0}};
    scene.meshes[0].normals.assign(3, glm::normalize(glm::vec3(1, 0, 1)));
    scene.instances[0].transform[2][2] = 0.1f;
    Surface s = look(scene, {0.25f, 0.25f, 1.0f}, {0, 0, -1});
    glm::vec3 expected = glm::normalize(glm::vec3(0.1f, 0, 1));
    EXPECT_NEAR(glm::length(s.normal - expected), 0.0f, 1e-5f);
    EXPECT_NEAR(glm::length(s.geometric_normal - expected), 0.0f, 1e-5f);
}

TEST(Surface, NormalMapFollowsTheTangentFrame) {
    Scene scene = textured_triangle();
    // About (.6, .4, .69) in tangent space.
    scene.textures.push_back({"normal", {1, 1, {204, 179, 216, 255}, false}});
    scene.materials[0].normal_texture.texture = 0;
    glm::vec3 m = glm::normalize(glm::vec3(204, 179, 216) / 255.0f * 2.0f - 1.0f);
    Surface s = look(scene, {0.25f, 0.25f, 1.0f}, {0, 0, -1});
    EXPECT_NEAR(glm::length(s.normal - m), 0.0f, 1e-5f);

    // Handedness turns the bitangent, and so does a mirroring transform.
    scene.meshes[0].tangents.assign(3, {1, 0, 0, -1});
    s = look(scene, {0.25f, 0.25f, 1.0f}, {0, 0, -1});
    EXPECT_NEAR(glm::length(s.normal - m * glm::vec3(1, -1, 1)), 0.0f, 1e-5f);
    scene.meshes[0].tangents.assign(3, {1, 0, 0, 1});
    scene.instances[0].transform[0][0] = -1.0f;
    s = look(scene, {-0.25f, 0.25f, 1.0f}, {0, 0, -1});
    EXPECT_NEAR(glm::length(s.normal - m * glm::vec3(-1, 1, 1)), 0.0f, 1e-5f);

    // From behind, the same surface.
    scene.instances[0].transform[0][0] = 1.0f;
    s = look(scene, {0.25f, 0.25f, -1.0f}, {0, 0, 1});
    EXPECT_FALSE(s.front);
    EXPECT_NEAR(glm::length(s.normal - m), 0.0f, 1e-5f);
}

// The ray caster's copy of a triangle is a shortcut, not another surface.
TEST(Surface, IsTheSameFromTheMeshAndFromTheCopy) {
    Scene scene = textured_triangle();
    scene.textures.push_back({"normal", {1, 1, {204, 179, 216, 255}, false}});
    scene.materials[0].normal_texture.texture = scene.materials[0].base_color_texture.texture = 0;
    scene.instances[0].transform = glm::mat4(glm::mat3(-2, 0.5f, 0, 0, 1, 0.3f, 0.1f, 0, 3));
    RayCaster rays(scene);
    Hit hit;
    glm::vec3 inside = transform_point(scene.instances[0].transform, {0.2f, 0.3f, 0});
    ASSERT_TRUE(rays.intersect({inside + glm::vec3(0, 0, 1), {0, 0, -1}}, hit));
    Surface copied = surface_at(scene, hit, {0, 0, -1});
    hit.shading = nullptr;
    Surface direct = surface_at(scene, hit, {0, 0, -1});
    EXPECT_EQ(copied.position, direct.position);
    EXPECT_EQ(copied.normal, direct.normal);
    EXPECT_EQ(copied.base_color, direct.base_color);
    EXPECT_NE(copied.normal, copied.geometric_normal) << "the normal map must have done something";
}

TEST(Surface, ShadingNormalFacesTheRay) {
    Scene scene = textured_triangle();
    scene.meshes[0].normals.assign(3, glm::normalize(glm::vec3(-1, 0, -0.5f)));
    glm::vec3 direction = glm::normalize(glm::vec3(-1, 0, -0.2f));
    Surface s = look(scene, glm::vec3(0.25f, 0.25f, 0.0f) - direction, direction);
    EXPECT_GT(glm::dot(s.normal, s.geometric_normal), 0.0f);
    EXPECT_GT(glm::dot(s.normal, -direction), 0.0f);
    EXPECT_NEAR(glm::length(s.normal), 1.0f, 1e-5f);
}

TEST(Surface, TransmissionTakesItsShareFromTheLobes) {
    Scene scene = textured_triangle();
    Surface opaque = look(scene, {0.25f, 0.25f, 1.0f}, {0, 0, -1});
    scene.materials[0].transmission = 0.75f;
    Surface glass = look(scene, {0.25f, 0.25f, 1.0f}, {0, 0, -1});
    EXPECT_FLOAT_EQ(glass.brdf.diffuse.g, 0.25f * opaque.brdf.diffuse.g);
    EXPECT_FLOAT_EQ(glass.brdf.f0.g, 0.25f * opaque.brdf.f0.g);
    EXPECT_FLOAT_EQ(glass.transmission, 0.75f);
    scene.materials[0].metallic = 1.0f;
    EXPECT_EQ(look(scene, {0.25f, 0.25f, 1.0f}, {0, 0, -1}).transmission, 0.0f) << "metals are opaque";
}

TEST(Surface, EmissionTextureScalesTheFactor) {
    Scene scene = textured_triangle();
    scene.textures.push_back(black_white(false));
    scene.materials[0].emission = {8, 4, 2};
    scene.materials[0].emission_texture.texture = 0;
    EXPECT_NEAR(look(scene, {0.5f, 0.25f, 1.0f}, {0, 0, -1}).emission.r, 4.0f, 1e-5f);
    EXPECT_NEAR(emission_at(scene, 0, 0, {0.5f, 0.25f}).g, 2.0f, 1e-5f);
}

} // namespace
} // namespace luxel
