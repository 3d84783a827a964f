// SPDX-License-Identifier: MIT
// What nodes do to what they show: instancing, visibility, flattening, places far from the origin.
#include "scene/gltf/test_gltf.h"

namespace luxel {
namespace {

using testing::TestGltf;

glm::vec3 at(const Instance& i, glm::vec3 p) { return glm::vec3(i.transform * glm::vec4(p, 1.0f)); }
void expect_near(glm::vec3 a, glm::vec3 b, float tolerance = 1e-5f) {
    EXPECT_LT(glm::length(a - b), tolerance) << a.x << " " << a.y << " " << a.z;
}

TEST(GltfNodes, GpuInstancing) {
    constexpr int int8 = 5120, int16 = 5122;
    for (const bool required : {false, true}) {
        for (const int component : {5126, int8, int16}) {
            TestGltf file;
            nlohmann::json& node = file.json["nodes"][0];
            node["translation"] = {0, 0, 5};
            nlohmann::json attributes;
            attributes["TRANSLATION"] = file.add_vectors<3>({{1, 0, 0}, {0, 2, 0}});
            attributes["SCALE"] = file.add_vectors<3>({{2, 2, 2}, {1, 1, -1}});
            // A quarter turn about z, and half a turn.
            if (component == int8)
                attributes["ROTATION"] =
                    file.add_accessor<std::int8_t>({0, 0, 90, 90, 0, 0, 127, 0}, 2, "VEC4", int8);
            else if (component == int16)
                attributes["ROTATION"] =
                    file.add_accessor<std::int16_t>({0, 0, 23170, 23170, 0, 0, 32767, 0}, 2, "VEC4", int16);
            else
                attributes["ROTATION"] =
                    file.add_vectors<4>({{0, 0, 0.70710678f, 0.70710678f}, {0, 0, 1, 0}});
            if (component != 5126) file.accessor(attributes["ROTATION"].get<int>())["normalized"] = true;
            node["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = attributes;
            file.json["extensionsUsed"] = {"EXT_mesh_gpu_instancing"};
            if (required) file.json["extensionsRequired"] = {"EXT_mesh_gpu_instancing"};
            const Scene scene = file.load();
            EXPECT_TRUE(scene.warnings.empty());
            ASSERT_EQ(scene.instances.size(), 2u);
            EXPECT_EQ(scene.triangles(), 2u);
            expect_near(at(scene.instances[0], {1, 0, 0}), {1, 2, 5});
            expect_near(at(scene.instances[1], {1, 0, 3}), {-1, 2, 2});
            EXPECT_LT(handedness(scene.instances[1].transform), 0.0f);
        }
    }
}

TEST(GltfNodes, GpuInstancingOfBadFiles) {
    TestGltf file;
    nlohmann::json& attributes = file.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"];
    attributes["TRANSLATION"] = file.add_vectors<3>({{1, 0, 0}, {std::nanf(""), 2, 0}});
    const Scene scene = file.load();
    EXPECT_EQ(scene.instances.size(), 1u);
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_CONTAINS(scene.warnings[0], "an instance without a finite place is left out");
    TestGltf uneven;
    nlohmann::json& two = uneven.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"];
    two["TRANSLATION"] = uneven.add_vectors<3>({{1, 0, 0}, {0, 2, 0}});
    two["SCALE"] = uneven.add_vectors<3>({{1, 1, 1}});
    EXPECT_CONTAINS(testing::sentence(Fault::bad_input, [&] { uneven.load(); }), "instances");
}

TEST(GltfNodes, InvisibleNodesHideMeshesAndLightsBelowThem) {
    TestGltf file;
    const nlohmann::json hidden = {{"KHR_node_visibility", {{"visible", false}}}};
    const nlohmann::json visible = {{"KHR_node_visibility", {{"visible", true}}},
                                    {"KHR_lights_punctual", {{"light", 0}}}};
    file.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}}};
    file.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 0.7}, {"znear", 0.1}}}}};
    file.json["nodes"] = {{{"mesh", 0}},
                          {{"mesh", 0}, {"extensions", hidden}, {"children", {2}}},
                          {{"mesh", 0}, {"extensions", visible}, {"camera", 0}},
                          {{"mesh", 0}, {"extensions", visible}}};
    file.json["scenes"][0]["nodes"] = {0, 1, 3};
    file.json["extensionsRequired"] = {"KHR_node_visibility"};
    const Scene scene = file.load();
    EXPECT_EQ(scene.instances.size(), 2u);
    EXPECT_EQ(scene.lights.size(), 1u);
    EXPECT_EQ(scene.cameras.size(), 1u);
    EXPECT_TRUE(scene.warnings.empty());
}

TEST(GltfNodes, ExtensionsThatAreNotReadAreCounted) {
    TestGltf file;
    file.json["nodes"][0]["extensions"]["MSFT_lod"] = {{"ids", {0}}};
    file.json["nodes"].push_back({{"mesh", 0}, {"extensions", {{"MSFT_lod", {{"ids", {0}}}}}}});
    file.json["scenes"][0]["nodes"] = {0, 1};
    file.primitive()["extensions"]["VENDOR_splines"] = nlohmann::json::object();
    const Scene scene = file.load();
    ASSERT_EQ(scene.warnings.size(), 2u);
    EXPECT_CONTAINS(scene.warnings[0], "the extension MSFT_lod of a node is not supported");
    EXPECT_CONTAINS(scene.warnings[0], "(2 times)");
    EXPECT_CONTAINS(scene.warnings[1], "the extension VENDOR_splines of a primitive");
}

// A scale of 0 in one axis leaves a surface; its front is where that of a thin object would be.
TEST(GltfNodes, FlattenedNodesKeepTheirSurface) {
    struct Case {
        nlohmann::json node;
        glm::vec3 normal;
    };
    const float half = std::sqrt(0.5f);
    for (const Case& c : {Case{{{"scale", {1, 1, 0}}}, {0, 0, 1}}, Case{{{"scale", {-1, 1, 0}}}, {0, 0, 1}},
                          Case{{{"scale", {1, 1, 0}}, {"rotation", {0, half, 0, half}}}, {1, 0, 0}},
                          Case{{{"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 7, 0, 0, 1}}}, {0, 0, 1}},
                          Case{{{"scale", {1e-5, 1e-5, 0}}}, {0, 0, 1}}}) {
        TestGltf file;
        file.json["nodes"][0] = c.node;
        file.json["nodes"][0]["children"] = {1};
        file.json["nodes"].push_back({{"mesh", 0}});
        const Scene scene = file.load();
        ASSERT_EQ(scene.instances.size(), 1u) << c.node;
        EXPECT_TRUE(scene.warnings.empty());
        const Instance& i = scene.instances[0];
        const glm::vec3 a = at(i, {0, 0, 0}), b = at(i, {1, 0, 0}), d = at(i, {0, 1, 0});
        expect_near(glm::normalize(glm::cross(b - a, d - a)) * handedness(i.transform), c.normal);
        const glm::vec3 x(i.transform[0]), y(i.transform[1]);
        expect_near(glm::normalize(glm::cross(x, y)) * handedness(i.transform), c.normal);
        EXPECT_LT(glm::length(at(i, {0, 0, 1}) - a), 1.1e-6f * 1.5f); // no thickness to be seen
    }
    TestGltf line;
    line.json["nodes"].push_back({{"mesh", 0}, {"scale", {1, 0, 0}}});
    line.json["scenes"][0]["nodes"] = {0, 1};
    const Scene scene = line.load();
    EXPECT_EQ(scene.instances.size(), 1u);
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_CONTAINS(scene.warnings[0], "scaled to nothing");
}

// A place with UTM coordinates is the same place: everything moves by Scene::origin, nothing is rounded away.
TEST(GltfNodes, ScenesFarAwayAreMovedToTheOrigin) {
    const auto load = [](glm::dvec3 where, bool in_vertices) {
        TestGltf file;
        file.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}}};
        file.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 0.7}, {"znear", 0.1}}}}};
        file.json["nodes"] = {
            {{"translation", {where.x, where.y, where.z}}, {"children", {1, 2, 3}}},
            {{"mesh", 0}, {"translation", {0.001, 0, 0}}},
            {{"camera", 0}, {"translation", {0, 0.002, 0}}},
            {{"translation", {0, 0, 0.003}}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}}};
        if (in_vertices) {
            file.attributes()["POSITION"] =
                file.add_vectors<3>({{65536, 0, 0}, {65537, 0, 0}, {65536, 1, 0}});
            file.json["nodes"][1]["translation"] = {0.001 - 65536, 0, 0};
        }
        return file.load();
    };
    const glm::dvec3 utm(500003.25, 120, 5431007.5);
    for (const bool in_vertices : {false, true}) {
        const Scene near = load(glm::dvec3(0.0), in_vertices), far = load(utm, in_vertices);
        EXPECT_EQ(near.origin, glm::dvec3(0.0));
        EXPECT_LT(glm::length(far.origin - utm), 4.0);
        const glm::vec3 offset(utm - far.origin);
        expect_near(at(far.instances[0], {0, 0, 0}) - offset, at(near.instances[0], {0, 0, 0}), 1e-6f);
        expect_near(at(near.instances[0], near.meshes[0].positions[1]), {1.001f, 0, 0}, 1e-6f);
        expect_near(at(far.instances[0], far.meshes[0].positions[1]) - offset, {1.001f, 0, 0}, 1e-6f);
        expect_near(far.cameras[0].position - offset, {0, 0.002f, 0}, 1e-6f);
        expect_near(far.lights[0].position - offset, {0, 0, 0.003f}, 1e-6f);
    }
}

} // namespace
} // namespace luxel
