// SPDX-License-Identifier: MIT
#include "scene/validate.h"

#include <limits>

#include <gtest/gtest.h>

#include "core/error.h"
#include "scene/procedural.h"

namespace luxel {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();

// One triangle with every kind of thing that a scene can hold.
Scene complete_scene() {
    Scene scene;
    Texture& texture = scene.textures.emplace_back();
    texture.pixels.width = texture.pixels.height = 1;
    texture.pixels.rgba = {1, 2, 3, 4};
    scene.materials.emplace_back().base_color_texture.texture = 0;
    Mesh& mesh = scene.meshes.emplace_back();
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.normals.assign(3, {0, 0, 1});
    mesh.texcoords[0].assign(3, {0, 0});
    mesh.indices = {0, 1, 2};
    scene.instances.emplace_back();
    shared::Light& light = scene.lights.emplace_back();
    light = {};
    light.type = shared::LIGHT_SPOT;
    light.direction = {0, 0, -1};
    light.inner = 0.1f;
    light.outer = 0.2f;
    scene.cameras.emplace_back();
    scene.environment.radiance = Image(2, 1, 3, 1.0f);
    return scene;
}

struct Damage {
    const char* reason; // part of the sentence
    void (*inflict)(Scene&);
};
void PrintTo(const Damage& d, std::ostream* out) { *out << d.reason; }

class Validate : public ::testing::TestWithParam<Damage> {};

TEST(ValidateScene, AcceptsSoundScenes) {
    EXPECT_NO_THROW(validate_scene(complete_scene(), "test"));
    EXPECT_NO_THROW(validate_scene(cornell(), "cornell"));
}

TEST_P(Validate, RefusesDamage) {
    Scene scene = complete_scene();
    GetParam().inflict(scene);
    try {
        validate_scene(scene, "file.gltf");
        FAIL() << "accepted";
    } catch (const Error& error) {
        const std::string text = error.what();
        EXPECT_EQ(int(error.fault()), int(Fault::bad_input));
        EXPECT_TRUE(text.starts_with("file.gltf: ")) << text;
        EXPECT_NE(text.find(GetParam().reason), std::string::npos) << text;
    }
}

INSTANTIATE_TEST_SUITE_P(
    , Validate,
    ::testing::Values(Damage{"no triangles", [](Scene& s) { s.instances.clear(); }},
                      Damage{"mesh 0: it has no triangles", [](Scene& s) { s.meshes[0].indices.clear(); }},
                      Damage{"parts of one", [](Scene& s) { s.meshes[0].indices.push_back(0); }},
                      Damage{"an index is out of range", [](Scene& s) { s.meshes[0].indices[1] = 3; }},
                      Damage{"differ in length", [](Scene& s) { s.meshes[0].normals.pop_back(); }},
                      Damage{"differ in length", [](Scene& s) { s.meshes[0].texcoords[1].resize(2); }},
                      Damage{"a vertex is not finite", [](Scene& s) { s.meshes[0].positions[2].y = nan; }},
                      Damage{"a normal is not",
                             [](Scene& s) {
                                 s.meshes[0].normals[0] = {0, 0, 2};
                             }},
                      Damage{"its material does not exist", [](Scene& s) { s.meshes[0].material = 1; }},
                      Damage{"no tangents for its normal texture",
                             [](Scene& s) { s.materials[0].normal_texture.texture = 0; }},
                      Damage{"its mesh does not exist", [](Scene& s) { s.instances[0].mesh = -1; }},
                      Damage{"transform is not finite",
                             [](Scene& s) { s.instances[0].transform[3].x = nan; }},
                      Damage{"not affine", [](Scene& s) { s.instances[0].transform[0].w = 1; }},
                      Damage{"singular", [](Scene& s) { s.instances[0].transform[1] = glm::vec4(0); }},
                      Damage{"too far away", [](Scene& s) { s.instances[0].transform[3].x = 1e20f; }},
                      Damage{"material 0: its color", [](Scene& s) { s.materials[0].base_color.r = 1.5f; }},
                      Damage{"metallic or roughness", [](Scene& s) { s.materials[0].roughness = nan; }},
                      Damage{"emission", [](Scene& s) { s.materials[0].emission.g = -1; }},
                      Damage{"index of refraction", [](Scene& s) { s.materials[0].ior = 0.5f; }},
                      Damage{"a texture that does not exist",
                             [](Scene& s) { s.materials[0].emission_texture.texture = 5; }},
                      Damage{"coordinate set", [](Scene& s) { s.materials[0].base_color_texture.set = 2; }},
                      Damage{"texture 0: its pixels", [](Scene& s) { s.textures[0].pixels.rgba.pop_back(); }},
                      Damage{"texture 0: its size", [](Scene& s) { s.textures[0].pixels.width = 0; }},
                      Damage{"light 0: its intensity", [](Scene& s) { s.lights[0].intensity.r = -1; }},
                      Damage{"light 0: its direction", [](Scene& s) { s.lights[0].direction = {0, 0, 0}; }},
                      Damage{"cone angles", [](Scene& s) { s.lights[0].outer = 0.05f; }},
                      Damage{"camera 0: its field of view", [](Scene& s) { s.cameras[0].yfov = 4; }},
                      Damage{"along its up", [](Scene& s) { s.cameras[0].up = s.cameras[0].forward; }},
                      Damage{"near and far", [](Scene& s) { s.cameras[0].near = 0; }},
                      Damage{"environment: a texel", [](Scene& s) { s.environment.radiance.data[4] = nan; }}),
    [](const auto& test) { return "Case" + std::to_string(test.index); });

} // namespace
} // namespace luxel
