// SPDX-License-Identifier: MIT
// Meshes, accessors and nodes of glTF files.
#include <numbers>

#include <meshoptimizer.h>

#include "scene/gltf/test_gltf.h"

namespace luxel {
namespace {

using testing::TestGltf;

constexpr int int8 = 5120, uint8 = 5121, int16 = 5122, uint16 = 5123, uint32 = 5125;

void expect_near(glm::vec3 a, glm::vec3 b, float tolerance = 1e-6f) {
    EXPECT_NEAR(a.x, b.x, tolerance);
    EXPECT_NEAR(a.y, b.y, tolerance);
    EXPECT_NEAR(a.z, b.z, tolerance);
}

TEST(Gltf, LoadsOneTriangle) {
    TestGltf file;
    const Scene scene = file.load();
    ASSERT_EQ(scene.meshes.size(), 1u);
    EXPECT_EQ(scene.meshes[0].indices, (std::vector<std::uint32_t>{0, 1, 2}));
    for (const glm::vec3& n : scene.meshes[0].normals) expect_near(n, {0, 0, 1});
    EXPECT_EQ(scene.name, "scene");
    EXPECT_TRUE(scene.warnings.empty());
    EXPECT_TRUE(scene.cameras.empty());
}

TEST(Gltf, LoadsBinaryFileAndDataUri) {
    TestGltf binary;
    const auto bytes = binary.glb();
    const auto path = binary.folder.add("scene.glb", std::span<const std::uint8_t>(bytes));
    EXPECT_EQ(load_gltf(path).meshes[0].positions[1], glm::vec3(1, 0, 0));

    // The triangle's first vertex, (0, 0, 0), and two more from 24 bytes: 32 zero digits are 24 zero bytes.
    TestGltf text;
    text.json["buffers"] = {
        {{"uri", "data:application/octet-stream;base64," + std::string(32, 'A') + "AACAPwAAgD8AAIA/"},
         {"byteLength", 36}}};
    EXPECT_EQ(text.load().meshes[0].positions[2], glm::vec3(1, 1, 1));
}

TEST(Gltf, DecodesPercentOnce) {
    TestGltf file;
    file.folder.add("a b%20.bin", std::span<const std::uint8_t>(file.bytes));
    file.json["buffers"] = {{{"uri", "a%20b%2520.bin"}, {"byteLength", file.bytes.size()}}};
    EXPECT_EQ(file.load().triangles(), 1u);
}

TEST(Gltf, TurnsStripsAndFansIntoTriangles) {
    TestGltf file;
    file.attributes()["POSITION"] = file.add_vectors<3>({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
    file.primitive()["mode"] = 6;
    const Mesh fan = file.load().meshes[0];
    EXPECT_EQ(fan.indices.size(), 6u);
    for (const glm::vec3& n : fan.normals) expect_near(n, {0, 0, 1});

    file.attributes()["POSITION"] =
        file.add_vectors<3>({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 2, 0}});
    file.primitive()["mode"] = 5;
    file.json.erase("buffers");
    const Mesh strip = file.load().meshes[0];
    EXPECT_EQ(strip.indices.size(), 9u);
    for (const glm::vec3& n : strip.normals) expect_near(n, {0, 0, 1});
}

TEST(Gltf, SkipsPointsAndLinesWithACount) {
    TestGltf file;
    auto points = file.primitive();
    points["mode"] = 0;
    file.json["meshes"][0]["primitives"].push_back(points);
    points["mode"] = 3;
    file.json["meshes"][0]["primitives"].push_back(points);
    const Scene scene = file.load();
    EXPECT_EQ(scene.triangles(), 1u);
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_CONTAINS(scene.warnings[0], "points and lines are not drawn (2 times)");
}

TEST(Gltf, ReadsIndicesOfEveryWidth) {
    TestGltf file;
    const auto check = [&](int accessor) {
        file.primitive()["indices"] = accessor;
        file.json.erase("buffers");
        const Scene scene = file.load();
        expect_near(scene.meshes[0].normals[0], {0, 0, -1});
    };
    check(file.add_accessor<std::uint8_t>({0, 2, 1}, 3, "SCALAR", uint8));
    check(file.add_accessor<std::uint16_t>({0, 2, 1}, 3, "SCALAR", uint16));
    check(file.add_accessor<std::uint32_t>({0, 2, 1}, 3, "SCALAR", uint32));
}

TEST(Gltf, ReadsInterleavedNormalizedAndQuantizedAttributes) {
    TestGltf file;
    // Position as int16 in whole units (KHR_mesh_quantization), color as normalized uint8, stride 12.
    struct Vertex {
        std::int16_t position[4];
        std::uint8_t color[4];
    };
    const std::vector<Vertex> vertices{{{0, 0, 0, 0}, {255, 0, 51, 255}},
                                       {{300, 0, 0, 0}, {0, 255, 0, 255}},
                                       {{0, -200, 0, 0}, {0, 0, 0, 0}}};
    const int view = file.add_view(vertices.data(), vertices.size() * sizeof(Vertex));
    file.json["bufferViews"][std::size_t(view)]["byteStride"] = sizeof(Vertex);
    file.json["accessors"].push_back(
        {{"bufferView", view}, {"count", 3}, {"type", "VEC3"}, {"componentType", int16}});
    file.json["accessors"].push_back({{"bufferView", view},
                                      {"byteOffset", 8},
                                      {"count", 3},
                                      {"type", "VEC4"},
                                      {"componentType", uint8},
                                      {"normalized", true}});
    file.attributes()["POSITION"] = 1;
    file.attributes()["COLOR_0"] = 2;
    file.json["extensionsRequired"] = {"KHR_mesh_quantization"};
    const Mesh mesh = file.load().meshes[0];
    EXPECT_EQ(mesh.positions[1], glm::vec3(300, 0, 0));
    EXPECT_EQ(mesh.positions[2], glm::vec3(0, -200, 0));
    EXPECT_EQ(mesh.colors[0], glm::vec4(1, 0, 51.0f / 255.0f, 1));
    EXPECT_EQ(mesh.colors[2], glm::vec4(0));
}

TEST(Gltf, ClampsNormalizedMinusOne) {
    TestGltf file;
    const int normals =
        file.add_accessor<std::int8_t>({0, 0, -128, 0, 0, 0, -127, 0, 0, 0, -127, 0}, 3, "VEC3", int8);
    file.accessor(normals)["normalized"] = true;
    file.json["bufferViews"].back()["byteStride"] = 4;
    file.attributes()["NORMAL"] = normals;
    const Scene scene = file.load();
    for (const glm::vec3& n : scene.meshes[0].normals) expect_near(n, {0, 0, -1});
}

TEST(Gltf, AppliesSparseElements) {
    TestGltf file;
    const int values = file.add_view(std::vector<float>{0, 5, 0}.data(), 12);
    const int indices = file.add_view(std::vector<std::uint8_t>{2}.data(), 1);
    file.accessor(0)["sparse"] = {{"count", 1},
                                  {"indices", {{"bufferView", indices}, {"componentType", uint8}}},
                                  {"values", {{"bufferView", values}}}};
    EXPECT_EQ(file.load().meshes[0].positions[2], glm::vec3(0, 5, 0));
}

TEST(Gltf, DecodesMeshoptCompression) {
    const std::vector<glm::vec3> positions{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {2, 2, 0}};
    const std::vector<std::uint32_t> indices{0, 1, 2, 2, 1, 3};
    std::vector<std::uint8_t> vertex_data(meshopt_encodeVertexBufferBound(4, 12));
    vertex_data.resize(
        meshopt_encodeVertexBuffer(vertex_data.data(), vertex_data.size(), positions.data(), 4, 12));
    std::vector<std::uint8_t> index_data(meshopt_encodeIndexBufferBound(6, 4));
    index_data.resize(meshopt_encodeIndexBuffer(index_data.data(), index_data.size(), indices.data(), 6));

    TestGltf file;
    const auto add = [&](const std::vector<std::uint8_t>& data, int count, int stride, const char* mode) {
        const int view = file.add_view(data.data(), data.size());
        auto& json = file.json["bufferViews"][std::size_t(view)];
        auto extension = json;
        extension.update({{"count", count}, {"byteStride", stride}, {"mode", mode}});
        json = {{"buffer", 1}, {"byteLength", count * stride}};
        json["extensions"]["EXT_meshopt_compression"] = extension;
        return view;
    };
    const int vertex_view = add(vertex_data, 4, 12, "ATTRIBUTES"),
              index_view = add(index_data, 6, 4, "TRIANGLES");
    file.json["accessors"] = {
        {{"bufferView", vertex_view}, {"count", 4}, {"type", "VEC3"}, {"componentType", 5126}},
        {{"bufferView", index_view}, {"count", 6}, {"type", "SCALAR"}, {"componentType", uint32}}};
    file.attributes()["POSITION"] = 0;
    file.primitive()["indices"] = 1;
    file.json["extensionsRequired"] = {"EXT_meshopt_compression"};
    file.save();
    file.json["buffers"].push_back({{"byteLength", 72}});
    const Scene scene = file.load();
    EXPECT_EQ(scene.triangles(), 2u);
    EXPECT_EQ(scene.meshes[0].positions[1], glm::vec3(2, 0, 0));

    // The decoder is fed garbage and a count that so few bytes cannot hold.
    auto& extension =
        file.json["bufferViews"][std::size_t(vertex_view)]["extensions"]["EXT_meshopt_compression"];
    extension["byteOffset"] = 0;
    EXPECT_CONTAINS(testing::sentence(Fault::bad_input, [&] { file.load(); }), "damaged");
    extension["count"] = std::uint64_t(1) << 31;
    EXPECT_CONTAINS(testing::sentence(Fault::bad_input, [&] { file.load(); }), "cannot come from");
}

TEST(Gltf, ComposesNodeTransforms) {
    TestGltf file;
    const float half = std::sqrt(0.5f);
    file.json["nodes"] = {{{"translation", {1, 2, 3}}, {"rotation", {0, 0, half, half}}, {"children", {1}}},
                          {{"mesh", 0}, {"matrix", {2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 10, 0, 0, 1}}}};
    const Scene scene = file.load();
    ASSERT_EQ(scene.instances.size(), 1u);
    // (1, 0, 0) is scaled to (2, 0, 0), moved to (12, 0, 0), turned to (0, 12, 0), moved by (1, 2, 3).
    expect_near(glm::vec3(scene.instances[0].transform * glm::vec4(1, 0, 0, 1)) + glm::vec3(scene.origin),
                {1, 14, 3}, 1e-5f);
}

TEST(Gltf, SharesMeshesBetweenInstances) {
    TestGltf file;
    file.json["nodes"] = {{{"mesh", 0}, {"name", "left"}},
                          {{"mesh", 0}, {"scale", {-1, 1, 1}}},
                          {{"mesh", 0}, {"scale", {0, 1, 0}}}};
    file.json["scenes"][0]["nodes"] = {0, 1, 2};
    const Scene scene = file.load();
    EXPECT_EQ(scene.meshes.size(), 1u);
    ASSERT_EQ(scene.instances.size(), 2u);
    EXPECT_EQ(scene.instances[0].name, "left");
    EXPECT_LT(glm::determinant(glm::mat3(scene.instances[1].transform)), 0.0f);
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_CONTAINS(scene.warnings[0], "scaled to nothing");
}

TEST(Gltf, ShowsParentlessNodesOfAFileWithoutScenes) {
    TestGltf file;
    file.json.erase("scene");
    file.json.erase("scenes");
    file.json["nodes"] = {{{"mesh", 0}}, {{"children", {0}}, {"translation", {0, 0, 7}}}};
    const Scene scene = file.load();
    ASSERT_EQ(scene.instances.size(), 1u);
    EXPECT_EQ(double(scene.instances[0].transform[3].z) + scene.origin.z, 7.0);
}

TEST(Gltf, DropsVerticesThatAPrimitiveDoesNotUse) {
    TestGltf file;
    std::vector<glm::vec3> many(1000, glm::vec3(9.0f));
    many[400] = {0, 0, 0}, many[500] = {1, 0, 0}, many[600] = {0, 1, 0};
    file.attributes()["POSITION"] = file.add_vectors<3>(many);
    file.attributes()["NORMAL"] = file.add_vectors<3>(std::vector<glm::vec3>(1000, glm::vec3(0, 0, 2)));
    file.primitive()["indices"] = file.add_accessor<std::uint16_t>({400, 500, 600}, 3, "SCALAR", uint16);
    const Mesh mesh = file.load().meshes[0];
    EXPECT_EQ(mesh.positions, (std::vector<glm::vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
    for (const glm::vec3& n : mesh.normals) expect_near(n, {0, 0, 1});
}

TEST(Gltf, ReadsCameras) {
    TestGltf file;
    file.json["cameras"] = {
        {{"type", "perspective"}, {"perspective", {{"yfov", 0.7}, {"znear", 0.1}}}, {"name", "front"}},
        {{"type", "orthographic"}, {"orthographic", {{"xmag", 1}, {"ymag", 3}, {"znear", 0}, {"zfar", 9}}}},
        {{"type", "perspective"}, {"perspective", {{"yfov", 0.7}, {"znear", 0.1}, {"zfar", 40}}}}};
    const float half = std::sqrt(0.5f);
    file.json["nodes"].push_back(
        {{"camera", 0}, {"rotation", {0, half, 0, half}}, {"translation", {0, 1, 0}}});
    file.json["nodes"].push_back({{"camera", 1}});
    file.json["nodes"].push_back({{"camera", 2}});
    file.json["scenes"][0]["nodes"] = {0, 1, 2, 3};
    const Scene scene = file.load();
    ASSERT_EQ(scene.cameras.size(), 3u);
    EXPECT_EQ(scene.cameras[0].name, "front");
    EXPECT_FLOAT_EQ(scene.cameras[0].yfov, 0.7f);
    EXPECT_FLOAT_EQ(scene.cameras[0].near, 0.1f);
    EXPECT_TRUE(std::isinf(scene.cameras[0].far)); // glTF 2.0, section 3.10.3: infinite without zfar
    EXPECT_FALSE(scene.cameras[0].orthographic());
    expect_near(scene.cameras[0].forward, {-1, 0, 0});
    expect_near(scene.cameras[0].up, {0, 1, 0});
    expect_near(scene.cameras[0].position, {0, 1, 0});
    EXPECT_EQ(scene.cameras[1].half_height, 3.0f);
    EXPECT_EQ(scene.cameras[1].near, 0.0f);
    EXPECT_EQ(scene.cameras[1].far, 9.0f);
    EXPECT_EQ(scene.cameras[2].far, 40.0f);
    EXPECT_TRUE(scene.warnings.empty());
}

TEST(Gltf, ReadsPunctualLights) {
    TestGltf file;
    file.json["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "spot"},
         {"color", {1, 0.5, 0}},
         {"intensity", 20},
         {"range", 4},
         {"spot", {{"innerConeAngle", 0.2}, {"outerConeAngle", 0.6}}}},
        {{"type", "directional"}},
        {{"type", "point"}, {"intensity", 3}}};
    const float half = std::sqrt(0.5f);
    for (int i = 0; i < 3; ++i)
        file.json["nodes"].push_back({{"translation", {1, 2, 3}},
                                      {"rotation", {-half, 0, 0, half}},
                                      {"extensions", {{"KHR_lights_punctual", {{"light", i}}}}}});
    file.json["scenes"][0]["nodes"] = {0, 1, 2, 3};
    const auto lights = file.load().lights;
    ASSERT_EQ(lights.size(), 3u);
    EXPECT_EQ(lights[0].type, shared::LIGHT_SPOT);
    EXPECT_EQ(lights[0].intensity, glm::vec3(20, 10, 0));
    EXPECT_EQ(lights[0].range, 4.0f);
    EXPECT_FLOAT_EQ(lights[0].inner, shared::versine(0.2f));
    EXPECT_FLOAT_EQ(lights[0].outer, shared::versine(0.6f));
    expect_near(lights[0].direction, {0, -1, 0});
    expect_near(lights[0].position, {1, 2, 3});
    EXPECT_EQ(lights[1].type, shared::LIGHT_DIRECTIONAL);
    EXPECT_EQ(lights[1].intensity, glm::vec3(1));
    EXPECT_EQ(lights[2].type, shared::LIGHT_POINT);
    EXPECT_EQ(lights[2].intensity, glm::vec3(3));

    // Blender's exporter: watts / (4 pi) x 683 ("standard"), or watts ("raw"); a sun's have no 4 pi.
    const auto watts = file.load({.lights = LightUnits::watts}).lights;
    EXPECT_FLOAT_EQ(watts[0].intensity.x, 20.0f / 683.0f);
    EXPECT_FLOAT_EQ(watts[1].intensity.x, 1.0f / 683.0f);
    const auto power = file.load({.lights = LightUnits::power}).lights;
    EXPECT_FLOAT_EQ(power[2].intensity.x, 3.0f / (4.0f * 3.14159265f));
    EXPECT_EQ(power[1].intensity.x, 1.0f);
}

} // namespace
} // namespace luxel
