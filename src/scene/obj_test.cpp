// SPDX-License-Identifier: MIT
#include "scene/obj.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/error.h"
#include "core/image_io.h"
#include "scene/surface.h"
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

// A mirror of gold's color, and a floor of plastic: Ks and Ns beside them say nothing.
TEST(ObjMaterial, PhysicalFactors) {
    const Scene scene =
        load_text("mtllib a.mtl\n" + std::string(triangle) + "usemtl m\nf 1 2 3\n",
                  "newmtl m\nKd .8 .7 .6\nKa 1 1 1\nKs .5 .5 .5\nNs 96\nPr 0\nPm 1\nPc .25\nPcr "
                  ".5\nNi 1.45\nsharpness 3\nKa 0 0 0\n");
    const Material& m = scene.materials[0];
    EXPECT_EQ(m.base_color, glm::vec4(0.8f, 0.7f, 0.6f, 1));
    EXPECT_EQ(m.metallic, 1.0f);
    EXPECT_EQ(m.roughness, 0.0f);
    EXPECT_EQ(m.specular, 1.0f);
    EXPECT_EQ(m.specular_color, glm::vec3(1.0f));
    EXPECT_EQ(m.ior, 1.45f);
    EXPECT_EQ(m.clearcoat, 0.25f);
    EXPECT_EQ(m.clearcoat_roughness, 0.5f);
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_CONTAINS(scene.warnings[0], "statements that are left out: Ka (2), Ks (1), Ns (1), sharpness (1)");
    EXPECT_EQ(load_material("Pr .25\n").roughness, 0.25f);
    EXPECT_EQ(load_material("Pr .25\n").metallic, 0.0f);
    EXPECT_EQ(load_material("Pm 1\n").roughness, 1.0f);
}

// Gray codes of one row, as a PNG.
std::vector<std::uint8_t> gray_row(const std::vector<float>& values, int rows = 1) {
    Image image(int(values.size()), rows, 3);
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < image.width; ++x) image.set_rgb(x, y, glm::vec3(values[std::size_t(x)]));
    return encode_png(image);
}

TEST(ObjMaterial, MapsMakeOneTexture) {
    const testing::TemporaryFolder folder;
    folder.add("rough.png", std::span<const std::uint8_t>(gray_row({0.2f, 0.6f})));
    folder.add("metal.png", std::span<const std::uint8_t>(gray_row({1.0f})));
    folder.add("hole.png", std::span<const std::uint8_t>(gray_row({0.0f, 1.0f})));
    folder.add("a.mtl", std::string_view("newmtl m\nmap_Pr rough.png\nmap_Pm metal.png\nmap_d hole.png\n"));
    const Scene scene =
        load_obj(folder.add("a.obj", "mtllib a.mtl\n" + std::string(triangle) + "usemtl m\nf 1 2 3\n"));
    EXPECT_TRUE(scene.warnings.empty());
    const Material& m = scene.materials[0];
    EXPECT_EQ(m.roughness, 1.0f);
    EXPECT_EQ(m.metallic, 1.0f);
    ASSERT_EQ(scene.textures.size(), 2u);
    const Texture& maps = scene.textures[std::size_t(m.metallic_roughness_texture.texture)];
    ASSERT_EQ(maps.pixels.width, 2);
    EXPECT_FALSE(maps.srgb);
    EXPECT_NEAR(maps.pixels.value(1), 0.2f, 1e-3f);
    EXPECT_NEAR(maps.pixels.value(5), 0.6f, 1e-3f);
    EXPECT_NEAR(maps.pixels.value(2), 1.0f, 1e-3f);
    EXPECT_EQ(m.alpha_mode, AlphaMode::mask);
    const Texture& color = scene.textures[std::size_t(m.base_color_texture.texture)];
    EXPECT_TRUE(color.srgb);
    EXPECT_EQ(color.pixels.value(3), 0.0f);
    EXPECT_EQ(color.pixels.value(7), 1.0f);
    EXPECT_EQ(color.pixels.value(4), 1.0f);
}

// Heights that rise by .1 from texel to texel to the right: the surface leans to the left. Rows that rise
// downward lean it up.
TEST(ObjMaterial, BumpMapsLeanTheNormal) {
    const testing::TemporaryFolder folder;
    std::vector<float> rising;
    for (int i = 0; i < 9; ++i) rising.push_back(0.1f * float(i));
    folder.add("right.png", std::span<const std::uint8_t>(gray_row(rising, 9)));
    Image down(9, 9, 3);
    for (int y = 0; y < 9; ++y)
        for (int x = 0; x < 9; ++x) down.set_rgb(x, y, glm::vec3(rising[std::size_t(y)]));
    folder.add("down.png", std::span<const std::uint8_t>(encode_png(down)));
    folder.add("a.mtl",
               std::string_view("newmtl r\nmap_Bump -bm 2 right.png\nnewmtl d\nbump -bm 2 down.png\n"));
    // Facing +z, u to the right and v up.
    const Scene scene = load_obj(folder.add(
        "a.obj", "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl r\nf 1/1 2/2 3/3\n"
                 "usemtl d\nf 1/1 2/2 3/3\n"));
    const glm::vec3 expected[] = {glm::normalize(glm::vec3(-0.2f, 0, 1)),
                                  glm::normalize(glm::vec3(0, 0.2f, 1))};
    for (std::uint32_t i = 0; i < 2; ++i) {
        Hit hit;
        hit.instance = i, hit.triangle = 0, hit.u = 0.3f, hit.v = 0.4f, hit.geometric_normal = {0, 0, 1};
        const Surface s = surface_at(scene, hit, {0, 0, -1});
        EXPECT_LT(glm::length(s.normal - expected[i]), 5e-3f) << s.normal.x << " " << s.normal.y;
    }
}

// A roof of two slopes: smooth in a group, flat without, and each file's own normals where it has some.
TEST(Obj, SmoothingGroups) {
    const std::string roof = "v 0 0 0\nv 1 1 0\nv 2 0 0\nv 0 0 2\nv 1 1 2\nv 2 0 2\n",
                      faces = "f 1 4 5 2\nf 2 5 6 3\n";
    const auto ridge = [&](const std::string& text) {
        const Scene scene = load_text(text);
        std::vector<glm::vec3> normals;
        for (const Mesh& mesh : scene.meshes)
            for (std::size_t i = 0; i < mesh.positions.size(); ++i)
                if (mesh.positions[i].x == 1.0f) normals.push_back(mesh.normals[i]);
        EXPECT_FALSE(normals.empty());
        return normals;
    };
    for (const char* on : {"s 1\n", "s on\n", "s 7\n"})
        for (const glm::vec3& n : ridge(roof + on + faces))
            EXPECT_LT(glm::length(n - glm::vec3(0, 1, 0)), 1e-6f) << on;
    for (const char* off : {"", "s off\n", "s 0\n"})
        for (const glm::vec3& n : ridge(roof + off + faces)) EXPECT_NEAR(n.y, std::sqrt(0.5f), 1e-6f) << off;
    // Each slope a group of its own; one group over two objects.
    for (const glm::vec3& n : ridge(roof + "s 1\nf 1 4 5 2\ns 2\nf 2 5 6 3\n"))
        EXPECT_NEAR(n.y, std::sqrt(0.5f), 1e-6f);
    for (const glm::vec3& n : ridge(roof + "s 1\no a\nf 1 4 5 2\no b\nf 2 5 6 3\n"))
        EXPECT_NEAR(n.y, 1.0f, 1e-6f);
    // What the file says stays, what it leaves out is made.
    for (const glm::vec3& n : ridge(roof + "vn 0 0 1\ns 1\nf 1//1 4//1 5//1 2//1\n"))
        EXPECT_EQ(n, glm::vec3(0, 0, 1));
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
