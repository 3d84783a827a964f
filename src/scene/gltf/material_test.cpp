// SPDX-License-Identifier: MIT
// Materials and textures of glTF files.
#include <numbers>

#include "core/image_io.h"
#include <webp/encode.h>

#include "scene/gltf/test_gltf.h"

namespace luxel {
namespace {

using testing::TestGltf;

// One pixel of the given display color.
std::vector<std::uint8_t> png(glm::vec3 color) {
    Image image(1, 1, 3);
    image.set_rgb(0, 0, color);
    return encode_png(image);
}

void add_texture(TestGltf& file, const std::string& uri) {
    file.json["images"].push_back({{"uri", uri}});
    file.json["textures"].push_back({{"source", file.json["images"].size() - 1}});
}

TEST(GltfMaterial, HasTheDefaultsOfTheFormat) {
    TestGltf file;
    file.material() = nlohmann::json::object();
    const Material m = file.load().materials[0];
    EXPECT_EQ(m.base_color, glm::vec4(1));
    EXPECT_EQ(m.metallic, 1.0f);
    EXPECT_EQ(m.roughness, 1.0f);
    EXPECT_EQ(m.emission, glm::vec3(0));
    EXPECT_EQ(m.ior, 1.5f);
    EXPECT_EQ(m.transmission, 0.0f);
    EXPECT_TRUE(m.thin);
    EXPECT_EQ(m.alpha_mode, AlphaMode::opaque);
    EXPECT_FALSE(m.double_sided);
    EXPECT_EQ(m.base_color_texture.texture, -1);
}

TEST(GltfMaterial, ReadsFactorsAndExtensions) {
    TestGltf file;
    file.material() = {
        {"name", "glass"},
        {"pbrMetallicRoughness",
         {{"baseColorFactor", {0.25, 0.5, 0.75, 1}}, {"metallicFactor", 0.5}, {"roughnessFactor", 0.125}}},
        {"emissiveFactor", {1, 0.5, 0}},
        {"alphaMode", "MASK"},
        {"alphaCutoff", 0.25},
        {"doubleSided", true},
        {"extensions",
         {{"KHR_materials_emissive_strength", {{"emissiveStrength", 12}}},
          {"KHR_materials_ior", {{"ior", 1.33}}},
          {"KHR_materials_specular", {{"specularFactor", 0.5}, {"specularColorFactor", {1, 2, 0}}}},
          {"KHR_materials_transmission", {{"transmissionFactor", 0.9}}},
          {"KHR_materials_volume",
           {{"thicknessFactor", 0.1}, {"attenuationDistance", 2}, {"attenuationColor", {1, 0.5, 0.25}}}},
          {"KHR_materials_clearcoat", {{"clearcoatFactor", 0.75}, {"clearcoatRoughnessFactor", 0.5}}}}}};
    const Scene scene = file.load();
    const Material& m = scene.materials[0];
    EXPECT_EQ(m.name, "glass");
    EXPECT_EQ(m.base_color, glm::vec4(0.25, 0.5, 0.75, 1));
    EXPECT_EQ(m.metallic, 0.5f);
    EXPECT_EQ(m.roughness, 0.125f);
    EXPECT_EQ(m.emission, glm::vec3(12, 6, 0));
    EXPECT_EQ(m.alpha_mode, AlphaMode::mask);
    EXPECT_EQ(m.alpha_cutoff, 0.25f);
    EXPECT_TRUE(m.double_sided);
    EXPECT_FLOAT_EQ(m.ior, 1.33f);
    EXPECT_EQ(m.specular, 0.5f);
    EXPECT_EQ(m.specular_color, glm::vec3(1, 2, 0));
    EXPECT_FLOAT_EQ(m.transmission, 0.9f);
    EXPECT_FALSE(m.thin);
    EXPECT_EQ(m.attenuation_distance, 2.0f);
    EXPECT_EQ(m.attenuation_color, glm::vec3(1, 0.5, 0.25));
    EXPECT_EQ(m.clearcoat, 0.75f);
    EXPECT_EQ(m.clearcoat_roughness, 0.5f);
    ASSERT_EQ(scene.warnings.size(), 2u) << "of what frames cannot draw";
    EXPECT_CONTAINS(scene.warnings[0], "clear coat");
    EXPECT_CONTAINS(scene.warnings[1], "rough glass");
}

TEST(GltfMaterial, RejectsAbsorptionThatCannotBe) {
    TestGltf file;
    file.material()["extensions"]["KHR_materials_volume"] = {{"attenuationDistance", 0}};
    EXPECT_THROW(file.load(), Error);
    file.material()["extensions"]["KHR_materials_volume"] = {{"attenuationColor", {2, 0, 0}}};
    EXPECT_THROW(file.load(), Error);
}

TEST(GltfMaterial, IsThinWithoutThickness) {
    TestGltf file;
    file.material()["extensions"]["KHR_materials_volume"]["attenuationColor"] = {1, 0, 0};
    EXPECT_TRUE(file.load().materials[0].thin);
}

TEST(GltfMaterial, ReadsBlendedMaterials) {
    TestGltf file;
    file.material() = {{"alphaMode", "BLEND"}, {"alphaCutoff", 0.1}};
    const Scene scene = file.load();
    EXPECT_EQ(scene.materials[0].alpha_mode, AlphaMode::blend);
    EXPECT_TRUE(scene.warnings.empty());
}

TEST(GltfMaterial, WarnsOfLooksItLeavesOut) {
    TestGltf file;
    file.material()["extensions"] = {{"KHR_materials_sheen", nlohmann::json::object()},
                                     {"KHR_materials_unlit", nlohmann::json::object()},
                                     {"VENDOR_unknown", nlohmann::json::object()}};
    file.json["extensionsUsed"] = {"KHR_materials_sheen", "KHR_materials_unlit", "VENDOR_unknown"};
    const Scene scene = file.load();
    ASSERT_EQ(scene.warnings.size(), 2u);
    EXPECT_CONTAINS(scene.warnings[0], "KHR_materials_sheen");
    EXPECT_CONTAINS(scene.warnings[1], "KHR_materials_unlit");
}

TEST(GltfTexture, IsSrgbByItsUse) {
    TestGltf file;
    file.folder.add("t/c.png", std::span<const std::uint8_t>(png({1, 0, 0})));
    add_texture(file, "t/c.png");
    file.material() = {{"pbrMetallicRoughness",
                        {{"baseColorTexture", {{"index", 0}}}, {"metallicRoughnessTexture", {{"index", 0}}}}},
                       {"emissiveTexture", {{"index", 0}}}};
    const Scene scene = file.load();
    const Material& m = scene.materials[0];
    ASSERT_EQ(scene.textures.size(), 2u);
    EXPECT_EQ(m.base_color_texture.texture, m.emission_texture.texture);
    EXPECT_TRUE(scene.textures[std::size_t(m.base_color_texture.texture)].srgb);
    EXPECT_FALSE(scene.textures[std::size_t(m.metallic_roughness_texture.texture)].srgb);
    for (const Texture& t : scene.textures)
        EXPECT_EQ(t.pixels.rgba, (std::vector<std::uint8_t>{255, 0, 0, 255}));
}

TEST(GltfTexture, IsReadFromBufferViewsAndDataUris) {
    TestGltf file;
    const auto bytes = png({0, 1, 0});
    const int view = file.add_view(bytes.data(), bytes.size());
    file.json["images"] = {{{"bufferView", view}, {"mimeType", "image/png"}}};
    file.json["textures"] = {{{"source", 0}}};
    file.material()["emissiveTexture"] = {{"index", 0}};
    EXPECT_EQ(file.load().textures[0].pixels.rgba, (std::vector<std::uint8_t>{0, 255, 0, 255}));
}

TEST(GltfTexture, TakesWrapAndFilterFromTheSampler) {
    TestGltf file;
    file.folder.add("c.png", std::span<const std::uint8_t>(png({1, 1, 1})));
    add_texture(file, "c.png");
    file.json["textures"][0]["sampler"] = 0;
    file.json["samplers"] = {{{"wrapS", 33071}, {"wrapT", 33648}, {"magFilter", 9728}}};
    file.material()["emissiveTexture"] = {{"index", 0}};
    const Texture t = file.load().textures[0];
    EXPECT_EQ(t.wrap_u, Wrap::clamp);
    EXPECT_EQ(t.wrap_v, Wrap::mirror);
    EXPECT_TRUE(t.nearest);
}

TEST(GltfTexture, AppliesTheTransform) {
    TestGltf file;
    file.folder.add("c.png", std::span<const std::uint8_t>(png({1, 1, 1})));
    add_texture(file, "c.png");
    file.material()["emissiveTexture"] = {{"index", 0},
                                          {"texCoord", 0},
                                          {"extensions",
                                           {{"KHR_texture_transform",
                                             {{"offset", {0.5, 0.25}},
                                              {"rotation", std::numbers::pi / 2},
                                              {"scale", {2, 3}},
                                              {"texCoord", 1}}}}}};
    const TextureUse use = file.load().materials[0].emission_texture;
    EXPECT_EQ(use.set, 1);
    // Scaled (2, 3); a quarter turn counter-clockwise with v down takes (u, v) to (v, -u): (3, -2); then
    // moved.
    const glm::vec3 uv = use.transform * glm::vec3(1, 1, 1);
    EXPECT_NEAR(uv.x, 3.5f, 1e-6f);
    EXPECT_NEAR(uv.y, -1.75f, 1e-6f);
}

TEST(GltfTexture, IsReplacedByGreyWhenMissingOrDamaged) {
    TestGltf file;
    file.folder.add("damaged.png", std::string_view("\x89PNG\r\n\x1a\nnonsense"));
    add_texture(file, "missing.png");
    add_texture(file, "damaged.png");
    file.json["textures"].push_back({{"extensions", {{"KHR_texture_basisu", {{"source", 0}}}}}});
    file.material() = {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}},
                       {"emissiveTexture", {{"index", 1}}},
                       {"normalTexture", {{"index", 2}}}};
    const Scene scene = file.load();
    ASSERT_EQ(scene.textures.size(), 3u);
    EXPECT_EQ(scene.textures[0].pixels.rgba, (std::vector<std::uint8_t>{128, 128, 128, 255}));
    EXPECT_EQ(scene.textures[1].pixels.rgba, (std::vector<std::uint8_t>{128, 128, 128, 255}));
    EXPECT_EQ(scene.textures[2].pixels.rgba, (std::vector<std::uint8_t>{128, 128, 255, 255}));
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_CONTAINS(scene.warnings[0], "3 texture images replaced by grey, first: ");
    EXPECT_CONTAINS(scene.warnings[0], "missing.png: no such file");

    const std::string strict = testing::sentence(Fault::bad_input, [&] { file.load({.strict = true}); });
    EXPECT_CONTAINS(strict, "missing.png");
}

// A lossless WebP of one green pixel, with a PNG beside it that is not there; KTX2, though required, is grey.
TEST(GltfTexture, WebpIsReadAndKtx2Named) {
    const std::vector<std::uint8_t> rgba = {0, 255, 0, 255};
    std::uint8_t* encoded = nullptr;
    const std::size_t size = WebPEncodeLosslessRGBA(rgba.data(), 1, 1, 4, &encoded);
    TestGltf file;
    file.folder.add("green.webp", std::span<const std::uint8_t>(encoded, size));
    WebPFree(encoded);
    add_texture(file, "missing.png");
    file.json["images"].push_back({{"uri", "green.webp"}});
    file.json["textures"][0]["extensions"]["EXT_texture_webp"] = {{"source", 1}};
    file.json["textures"].push_back({{"extensions", {{"KHR_texture_basisu", {{"source", 0}}}}}});
    file.json["extensionsRequired"] = {"EXT_texture_webp", "KHR_texture_basisu"};
    file.material() = {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}},
                       {"emissiveTexture", {{"index", 1}}}};
    const Scene scene = file.load();
    ASSERT_EQ(scene.textures.size(), 2u);
    EXPECT_EQ(scene.textures[0].pixels.rgba, rgba);
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_CONTAINS(scene.warnings[0], "1 texture image replaced by grey, first: textures[1]: is KTX2");
}

TEST(GltfTexture, DirectsTangentsOfNormalMaps) {
    TestGltf file;
    file.folder.add("n.png", std::span<const std::uint8_t>(png({0.5, 0.5, 1})));
    add_texture(file, "n.png");
    file.material()["normalTexture"] = {{"index", 0}, {"scale", 0.5}};
    // u runs along +y and v along -x: the tangent is +y, the texture's up is +x, cross(z, y) = -x.
    file.attributes()["TEXCOORD_0"] = file.add_vectors<2>({{0, 0}, {0, -1}, {1, 0}});
    const Scene scene = file.load();
    EXPECT_EQ(scene.materials[0].normal_scale, 0.5f);
    ASSERT_EQ(scene.meshes[0].tangents.size(), 3u);
    for (const glm::vec4& t : scene.meshes[0].tangents) EXPECT_EQ(t, glm::vec4(0, 1, 0, -1));
}

} // namespace
} // namespace luxel
