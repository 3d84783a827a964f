// SPDX-License-Identifier: MIT
// A scene written as glTF and read again is the same: its content key, and so every picture of it.
#include <gtest/gtest.h>

#include "reference/content_key.h"
#include "reference/reference.h"
#include "scene/export/gltf/gltf.h"
#include "scene/load.h"
#include "support/data.h"
#include "support/temporary_folder.h"

namespace luxel::testing {
namespace {

Scene written_and_read(const Scene& scene, const char* name, std::vector<std::string>* lost = nullptr) {
    const TemporaryFolder folder;
    const std::filesystem::path file = folder.path() / name;
    const std::vector<std::string> said = write_gltf(file, scene, {scene.cameras.at(0), 64, 48});
    if (lost) *lost = said;
    return load_scene(file.string());
}

Image picture(const Scene& scene, const Camera& camera) {
    ReferenceRequest request;
    request.camera = camera;
    request.width = 32, request.height = 24;
    request.components = {"direct", "diffuse1"};
    request.settings.spp = 4;
    const Estimate estimate = render_reference(RayCaster(scene), request);
    Image sum = estimate.mean.at("direct");
    const Image& bounce = estimate.mean.at("diffuse1");
    for (std::size_t i = 0; i < sum.data.size(); ++i) sum.data[i] += bounce.data[i];
    return sum;
}

// The reader's own scene, written and read, to the bit; what builtin scenes have beyond glTF (a material at
// the end for what has none) is added by the first reading.
TEST(ExportRoundTrip, GivesTheSameSceneAgain) {
    for (const char* name : {"cornell", "furnace", "sphere-in-box", "glass-metal", "water", "tree"}) {
        SCOPED_TRACE(name);
        const Scene scene = load_scene(std::string("builtin:") + name);
        const Scene once = written_and_read(scene, "a.glb"), again = written_and_read(once, "b.gltf");
        EXPECT_EQ(content_key(once), content_key(again));
        ASSERT_EQ(once.meshes.size(), scene.meshes.size());
        EXPECT_EQ(once.instances.size(), scene.instances.size());
        for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
            ASSERT_EQ(once.meshes[i].positions.size(), scene.meshes[i].positions.size());
            EXPECT_EQ(once.meshes[i].indices, scene.meshes[i].indices);
        }
        // In the world: the reading may move a mesh's origin, and its instances by as much.
        for (std::size_t i = 0; i < scene.instances.size(); ++i) {
            const Instance &a = scene.instances[i], &b = once.instances[i];
            const auto& before = scene.meshes[std::size_t(a.mesh)].positions;
            const auto& after = once.meshes[std::size_t(b.mesh)].positions;
            for (std::size_t v = 0; v < before.size(); ++v)
                EXPECT_LT(glm::length(
                              glm::vec3(a.transform * glm::vec4(before[v], 1.0f)) + glm::vec3(scene.origin) -
                              glm::vec3(b.transform * glm::vec4(after[v], 1.0f)) - glm::vec3(once.origin)),
                          2e-6f);
        }
        for (std::size_t i = 0; i < scene.materials.size(); ++i) {
            EXPECT_EQ(once.materials[i].emission, scene.materials[i].emission);
            EXPECT_EQ(once.materials[i].ior, scene.materials[i].ior);
            EXPECT_EQ(once.materials[i].thin, scene.materials[i].thin);
        }
        ASSERT_GE(once.cameras.size(), scene.cameras.size());
        for (std::size_t i = 0; i < scene.cameras.size(); ++i) {
            EXPECT_LT(glm::length(once.cameras[i].forward - scene.cameras[i].forward), 1e-6f);
            EXPECT_EQ(once.cameras[i].position, scene.cameras[i].position);
            EXPECT_EQ(once.cameras[i].yfov, scene.cameras[i].yfov);
            EXPECT_EQ(once.cameras[i].name, scene.cameras[i].name);
        }
    }
}

TEST(ExportRoundTrip, GivesTheSamePictureToTheBit) {
    for (const char* name : {"cornell", "sphere-in-box"}) {
        const Scene scene = load_scene(std::string("builtin:") + name);
        const Image before = picture(scene, scene.cameras[0]),
                    after = picture(written_and_read(scene, "a.glb"), scene.cameras[0]);
        EXPECT_EQ(before.data, after.data) << name;
    }
}

TEST(ExportRoundTrip, KeepsLights) {
    for (const char* name : {"shapes-point", "shapes-spot", "shapes-directional"}) {
        const Scene scene = load_scene(std::string("builtin:") + name),
                    read = written_and_read(scene, "a.glb");
        ASSERT_EQ(read.lights.size(), scene.lights.size());
        for (std::size_t i = 0; i < scene.lights.size(); ++i) {
            const shared::Light &a = scene.lights[i], &b = read.lights[i];
            EXPECT_EQ(a.type, b.type);
            EXPECT_EQ(a.intensity, b.intensity);
            EXPECT_EQ(a.range, b.range);
            if (a.type != shared::LIGHT_DIRECTIONAL) {
                EXPECT_EQ(a.position, b.position);
            }
            if (a.type == shared::LIGHT_POINT) continue;
            EXPECT_LT(glm::length(a.direction - b.direction), 1e-6f);
            if (a.type != shared::LIGHT_SPOT) continue;
            EXPECT_NEAR(a.inner, b.inner, 1e-6f * (1.0f + a.inner));
            EXPECT_NEAR(a.outer, b.outer, 1e-6f * (1.0f + a.outer));
        }
    }
}

// Everything a material can say, with textures in every place.
TEST(ExportRoundTrip, KeepsMaterialsAndTextures) {
    Scene scene = load_scene("builtin:cornell");
    Texture texture;
    texture.name = "dots";
    texture.pixels.width = 3, texture.pixels.height = 2;
    for (int i = 0; i < 24; ++i) texture.pixels.rgba.push_back(std::uint8_t(i * 10 + 3));
    texture.wrap_u = Wrap::clamp, texture.wrap_v = Wrap::mirror, texture.nearest = true;
    Texture color = texture;
    color.srgb = true;
    scene.textures = {color, texture};
    for (Mesh& mesh : scene.meshes)
        for (auto& set : mesh.texcoords) set.assign(mesh.positions.size(), {0.25f, 0.75f});
    Material& m = scene.materials[0];
    m.base_color = {0.1f, 0.2f, 0.3f, 0.4f}, m.metallic = 0.3f, m.roughness = 0.7f;
    m.emission = {3.0f, 0.1f, 0.7f}, m.ior = 1.31f, m.specular = 0.6f, m.specular_color = {0.9f, 0.8f, 0.7f};
    m.transmission = 0.35f, m.thin = false;
    m.alpha_mode = AlphaMode::mask, m.alpha_cutoff = 0.3f, m.double_sided = true;
    m.base_color_texture.texture = m.emission_texture.texture = 0;
    m.metallic_roughness_texture.texture = m.specular_texture.texture = 1;
    m.base_color_texture.set = 1;
    m.base_color_texture.transform =
        glm::mat3(0.0f, -2.0f, 0, 3.0f, 0.0f, 0, 0.5f, 0.25f, 1); // turned by 90 degrees
    std::vector<std::string> lost;
    const Scene read = written_and_read(scene, "a.glb", &lost);
    EXPECT_TRUE(lost.empty());
    const Material& r = read.materials[0];
    EXPECT_EQ(r.base_color, m.base_color);
    EXPECT_EQ(r.metallic, m.metallic);
    EXPECT_EQ(r.roughness, m.roughness);
    EXPECT_EQ(r.emission, m.emission);
    EXPECT_EQ(r.ior, m.ior);
    EXPECT_EQ(r.specular, m.specular);
    EXPECT_EQ(r.specular_color, m.specular_color);
    EXPECT_EQ(r.transmission, m.transmission);
    EXPECT_EQ(r.thin, m.thin);
    EXPECT_EQ(r.alpha_mode, m.alpha_mode);
    EXPECT_EQ(r.alpha_cutoff, m.alpha_cutoff);
    EXPECT_EQ(r.double_sided, m.double_sided);
    EXPECT_EQ(r.base_color_texture.set, 1);
    for (int c = 0; c < 3; ++c)
        EXPECT_LT(glm::length(r.base_color_texture.transform[c] - m.base_color_texture.transform[c]), 1e-6f);
    ASSERT_EQ(read.textures.size(), 2u);
    for (const TextureUse* use :
         {&r.base_color_texture, &r.emission_texture, &r.metallic_roughness_texture}) {
        const Texture& t = read.textures[std::size_t(use->texture)];
        EXPECT_EQ(t.pixels.rgba, texture.pixels.rgba);
        EXPECT_EQ(t.srgb, use != &r.metallic_roughness_texture);
        EXPECT_EQ(t.wrap_u, Wrap::clamp);
        EXPECT_EQ(t.wrap_v, Wrap::mirror);
        EXPECT_TRUE(t.nearest);
    }
}

TEST(ExportRoundTrip, RealScenes) {
    for (const char* name : {"cornell_box/cornell_box.gltf", "gltf_materials/SpecularTest.glb"}) {
        const auto file = data_file(name);
        if (!file) continue;
        const Scene scene = load_scene(file->string()), read = written_and_read(scene, "a.glb");
        EXPECT_EQ(content_key(scene), content_key(read)) << name;
    }
}

} // namespace
} // namespace luxel::testing
