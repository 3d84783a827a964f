// SPDX-License-Identifier: MIT
#include "scene/obj.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "core/image_io.h"
#include "support/temporary_folder.h"

namespace luxel {
namespace {

constexpr std::string_view triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

Scene load_text(const std::string& text, const std::string& mtl = "", const LoadOptions& options = {}) {
    const testing::TemporaryFolder folder;
    if (!mtl.empty()) folder.add("a.mtl", std::string_view(mtl));
    return load_obj(folder.add("a.obj", std::string_view(text)), options);
}

Material load_material(const std::string& mtl) {
    return load_text("mtllib a.mtl\n" + std::string(triangle) + "usemtl m\nf 1 2 3\n", "newmtl m\n" + mtl)
        .materials[0];
}

std::string error_of(const std::string& text) {
    try {
        load_text(text);
    } catch (const Error& error) {
        EXPECT_EQ(int(error.fault()), int(Fault::bad_input)) << error.what();
        return error.what();
    }
    ADD_FAILURE() << "no error for " << text.substr(0, 100);
    return {};
}

#define EXPECT_CONTAINS(text, part) EXPECT_NE((text).find(part), std::string::npos) << (text)

TEST(Obj, MakesFlatNormalsAndCutsPolygons) {
    const Scene scene = load_text("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n");
    EXPECT_EQ(scene.triangles(), 2u);
    for (const glm::vec3& n : scene.meshes[0].normals) EXPECT_EQ(n, glm::vec3(0, 0, 1));
    EXPECT_EQ(scene.materials.size(), 1u);
}

TEST(Obj, SharesVerticesAndFlipsTextureRows) {
    const Scene scene = load_text(std::string(triangle) + "v 1 1 0\nvn 0 0 2\nvt 0.25 1\nvt 0 0\n" +
                                  "f 1/1/1 2/2/1 3/2/1\nf -3/2/1 -1/2/1 -2/2/1\n");
    const Mesh& mesh = scene.meshes[0];
    EXPECT_EQ(mesh.positions.size(), 4u);
    EXPECT_EQ(mesh.indices, (std::vector<std::uint32_t>{0, 1, 2, 1, 3, 2}));
    EXPECT_EQ(mesh.normals[0], glm::vec3(0, 0, 1));
    EXPECT_EQ(mesh.texcoords[0][0], glm::vec2(0.25f, 0.0f));
    EXPECT_EQ(mesh.texcoords[0][1], glm::vec2(0.0f, 1.0f));
}

TEST(Obj, SplitsByObjectAndMaterial) {
    const Scene scene = load_text(
        "mtllib a.mtl\n" + std::string(triangle) +
            "o left\nusemtl a\nf 1 2 3\nusemtl b\nf 1 2 3\nusemtl a\nf 3 2 1\no right\nusemtl b\nf 1 2 3\n",
        "newmtl a\nKd 1 0 0\nnewmtl b\nKd 0 1 0\n");
    ASSERT_EQ(scene.instances.size(), 3u);
    EXPECT_EQ(scene.instances[0].name, "left");
    EXPECT_EQ(scene.instances[2].name, "right");
    EXPECT_EQ(scene.meshes[0].indices.size(), 6u);
    EXPECT_EQ(scene.materials[std::size_t(scene.meshes[1].material)].base_color, glm::vec4(0, 1, 0, 1));
}

TEST(ObjMaterial, DiffuseIsLambertian) {
    const Material m = load_material("Kd 0.25 0.5 0.75\nKe 5 4 3\n");
    EXPECT_EQ(m.base_color, glm::vec4(0.25, 0.5, 0.75, 1));
    EXPECT_EQ(m.metallic, 0.0f);
    EXPECT_EQ(m.roughness, 1.0f);
    EXPECT_EQ(m.specular, 0.0f);
    EXPECT_EQ(m.transmission, 0.0f);
    EXPECT_EQ(m.emission, glm::vec3(5, 4, 3));
    EXPECT_FALSE(m.double_sided);
}

TEST(ObjMaterial, ShininessBecomesRoughness) {
    const Material m = load_material("Kd 0 0 0\nKs 0.25 0.5 0.5\nNs 30\n");
    EXPECT_EQ(m.specular, 0.5f);
    EXPECT_EQ(m.specular_color, glm::vec3(0.5, 1, 1));
    EXPECT_FLOAT_EQ(m.roughness * m.roughness, 0.25f); // sqrt(2 / 32)
}

TEST(ObjMaterial, DissolveAndGlassTransmit) {
    const Material glass = load_material("Kd 0 0 0\nillum 7\nNi 1.5\nTf 1 0.5 0.5\n");
    EXPECT_EQ(glass.transmission, 1.0f);
    EXPECT_EQ(glass.ior, 1.5f);
    EXPECT_FALSE(glass.thin);
    EXPECT_EQ(glass.roughness, 0.0f);
    EXPECT_EQ(glass.base_color, glm::vec4(1, 0.5, 0.5, 1));
    const Material veil = load_material("Kd 1 1 1\nd 0.25\n");
    EXPECT_EQ(veil.transmission, 0.75f);
    EXPECT_TRUE(veil.thin);
    EXPECT_EQ(load_material("Tr 0.25\n").transmission, 0.25f);
    EXPECT_EQ(load_material("illum 2\nNi 1.5\nd 1\n").transmission, 0.0f);
}

TEST(ObjMaterial, ReadsTexturesBeneathTheFolder) {
    const testing::TemporaryFolder folder;
    Image red(1, 1, 3);
    red.set_rgb(0, 0, {1, 0, 0});
    folder.add("tex/red.png", std::span<const std::uint8_t>(encode_png(red)));
    folder.add("a.mtl", std::string_view("newmtl m\nmap_Kd tex\\red.png\nnewmtl n\nmap_Kd gone.png\n"));
    const auto path = folder.add("a.obj", "mtllib a.mtl\n" + std::string(triangle) + "usemtl m\nf 1 2 3\n");
    const Scene scene = load_obj(path);
    ASSERT_EQ(scene.textures.size(), 2u);
    EXPECT_EQ(scene.textures[0].pixels.rgba, (std::vector<std::uint8_t>{255, 0, 0, 255}));
    EXPECT_TRUE(scene.textures[0].srgb);
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_CONTAINS(scene.warnings[0], "1 texture image replaced by grey, first: gone.png");
    EXPECT_THROW(load_obj(path, {.strict = true}), Error);

    folder.add("a.mtl", std::string_view("newmtl m\nmap_Kd ../../etc/passwd\n"));
    ASSERT_EQ(load_obj(path).warnings.size(), 1u);
    EXPECT_CONTAINS(load_obj(path).warnings[0], "the path leaves the folder");
    EXPECT_THROW(load_obj(path, {.strict = true}), Error);
    folder.add("a.obj", "mtllib ../a.mtl\n" + std::string(triangle) + "f 1 2 3\n");
    EXPECT_THROW(load_obj(path), Error);
}

TEST(ObjMaterial, LibraryThatIsMissingIsAWarning) {
    const std::string text = "mtllib gone.mtl\n" + std::string(triangle) + "usemtl m\nf 1 2 3\n";
    const Scene scene = load_text(text);
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_CONTAINS(scene.warnings[0], "no material library \"gone.mtl\"");
    EXPECT_THROW(load_text(text, "", {.strict = true}), Error);
}

TEST(ObjMalformed, EndsWithOneSentence) {
    const std::string vertices(triangle);
    EXPECT_CONTAINS(error_of(""), "the file is empty");
    EXPECT_CONTAINS(error_of(vertices), "the scene has no triangles");
    EXPECT_CONTAINS(error_of(vertices + "l 1 2\np 3\n"), "the scene has no triangles");
    EXPECT_CONTAINS(error_of(vertices + "f 1 2 4\n"), "vertex 4 is out of range, there are 3");
    EXPECT_CONTAINS(error_of(vertices + "f 1 2 -9\n"), "out of range");
    EXPECT_CONTAINS(error_of(vertices + "f 1//1 2//1 3//1\n"), "normal 1 is out of range, there are 0");
    EXPECT_CONTAINS(error_of(vertices + "f 1/7 2/7 3/7\n"), "texture coordinate 7 is out of range");
    EXPECT_CONTAINS(error_of(vertices + "f 0 1 2\n"), "zero value for face index");
    EXPECT_CONTAINS(error_of(vertices + "f 4294967297 1 2\n"), "line 4: an index is too large");
    EXPECT_CONTAINS(error_of("v 0 0 nan\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"),
                    "line 1: \"nan\" is not a finite number");
    EXPECT_CONTAINS(error_of("v 0 0 1e999\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"), "not finite");
    std::string huge_face = vertices + "f";
    for (int i = 0; i < 2000; ++i) huge_face += " 1 2 3";
    EXPECT_CONTAINS(error_of(huge_face + "\n"), "line 4: a face with more than 1024 corners");
}

} // namespace
} // namespace luxel
