// SPDX-License-Identifier: MIT
// Morph targets by their weights, and skins, as they are before anything is animated.
#include "scene/gltf/test_gltf.h"

namespace luxel {
namespace {

using testing::TestGltf;
using Matrix = std::array<float, 16>;

void expect_near(glm::vec3 a, glm::vec3 b, float tolerance = 1e-5f) {
    EXPECT_LT(glm::length(a - b), tolerance) << a.x << " " << a.y << " " << a.z;
}
glm::vec3 shown(const Scene& scene, std::size_t instance, std::size_t vertex) {
    const Instance& i = scene.instances[instance];
    return glm::vec3(i.transform * glm::vec4(scene.meshes[std::size_t(i.mesh)].positions[vertex], 1.0f));
}

TEST(GltfRestPose, MorphWeights) {
    TestGltf file;
    file.attributes()["NORMAL"] = file.add_vectors<3>({{0, 0, 1}, {0, 0, 1}, {0, 0, 1}});
    file.primitive()["targets"] = {{{"POSITION", file.add_vectors<3>({{2, 0, 0}, {2, 0, 0}, {2, 0, 0}})},
                                    {"NORMAL", file.add_vectors<3>({{0, 1, 0}, {0, 0, 0}, {0, 0, 0}})}},
                                   {{"POSITION", file.add_vectors<3>({{0, 0, 8}, {0, 0, 8}, {0, 0, 8}})}}};
    file.json["meshes"][0]["weights"] = {1, 0.25};
    file.json["nodes"] = {{{"mesh", 0}}, {{"mesh", 0}, {"weights", {0.5, 0}}}, {{"mesh", 0}}};
    file.json["scenes"][0]["nodes"] = {0, 1, 2};
    const Scene scene = file.load();
    EXPECT_TRUE(scene.warnings.empty());
    EXPECT_EQ(scene.meshes.size(), 2u); // equal weights share
    expect_near(shown(scene, 0, 1), {3, 0, 2});
    expect_near(shown(scene, 1, 1), {2, 0, 0});
    EXPECT_EQ(scene.instances[2].mesh, scene.instances[0].mesh);
    expect_near(scene.meshes[0].normals[0], glm::normalize(glm::vec3(0, 1, 1)));
    expect_near(scene.meshes[0].normals[1], {0, 0, 1});

    // Without weights the targets rest; a wrong number of them is no morph.
    file.json["meshes"][0].erase("weights");
    file.json["nodes"][1].erase("weights");
    expect_near(shown(file.load(), 0, 1), {1, 0, 0});
    file.json["meshes"][0]["weights"] = {1};
    EXPECT_CONTAINS(testing::sentence(Fault::bad_input, [&] { file.load(); }),
                    "1 weights for 2 morph targets");
}

TEST(GltfRestPose, SparseTargetsAndFlatNormals) {
    TestGltf file;
    const std::vector<std::uint16_t> one{2};
    const glm::vec3 delta(0, 0, 1);
    const int index = file.add_view(one.data(), 2), value = file.add_view(&delta, 12);
    file.json["accessors"].push_back({{"count", 3},
                                      {"type", "VEC3"},
                                      {"componentType", 5126},
                                      {"sparse",
                                       {{"count", 1},
                                        {"indices", {{"bufferView", index}, {"componentType", 5123}}},
                                        {"values", {{"bufferView", value}}}}}});
    file.primitive()["targets"] = {{{"POSITION", int(file.json["accessors"].size()) - 1}}};
    file.json["meshes"][0]["weights"] = {1};
    const Scene scene = file.load();
    expect_near(shown(scene, 0, 2), {0, 1, 1});
    expect_near(scene.meshes[0].normals[0], glm::normalize(glm::vec3(0, -1, 1))); // of the morphed face
}

// A triangle whose third vertex follows the second joint.
struct Skinned : TestGltf {
    explicit Skinned(int joint_type = 5121, int weight_type = 5126) {
        attributes()["NORMAL"] = add_vectors<3>({{0, 0, 1}, {0, 0, 1}, {0, 0, 1}});
        const std::vector<int> joints{0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0};
        const std::vector<float> weights{1, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0};
        attributes()["JOINTS_0"] = joint_type == 5121 ? add<std::uint8_t>(joints, 1, joint_type)
                                                      : add<std::uint16_t>(joints, 1, joint_type);
        attributes()["WEIGHTS_0"] = weight_type == 5126   ? add<float>(weights, 1, weight_type)
                                    : weight_type == 5121 ? add<std::uint8_t>(weights, 255, weight_type)
                                                          : add<std::uint16_t>(weights, 65535, weight_type);
        if (weight_type != 5126) accessor(attributes()["WEIGHTS_0"].get<int>())["normalized"] = true;
        json["nodes"] = {{{"mesh", 0}, {"skin", 0}, {"translation", {100, 0, 0}}}, // has no say
                         {{"scale", {0.5, 0.5, 0.5}}, {"children", {2, 3}}},
                         {{"translation", {2, 0, 0}}},
                         {{"translation", {0, 4, 0}}}};
        json["scenes"][0]["nodes"] = {0, 1};
        json["skins"] = {{{"joints", {2, 3}}}};
    }
    template <class T, class From> int add(const std::vector<From>& values, float by, int type) {
        std::vector<T> scaled;
        for (const From v : values) scaled.push_back(T(float(v) * by));
        return add_accessor<T>(scaled, scaled.size() / 4, "VEC4", type);
    }
    void bind(const std::vector<Matrix>& matrices) {
        json["skins"][0]["inverseBindMatrices"] =
            add_accessor<Matrix>(matrices, matrices.size(), "MAT4", 5126);
    }
};

TEST(GltfRestPose, SkinsOfAllComponentTypes) {
    for (const int joints : {5121, 5123})
        for (const int weights : {5126, 5121, 5123}) {
            Skinned file(joints, weights);
            const Scene scene = file.load();
            EXPECT_TRUE(scene.warnings.empty());
            expect_near(shown(scene, 0, 0), {1, 0, 0});
            expect_near(shown(scene, 0, 1), {1.5f, 0, 0});
            expect_near(shown(scene, 0, 2), {0, 2.5f, 0});
        }
}

TEST(GltfRestPose, InverseBindMatricesTurnNormalsAndMirror) {
    Skinned file;
    file.json["nodes"][1]["scale"] = {0.5, 0.5, -0.5};
    const Matrix quarter{1, 0, 0, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1}; // about x: z to -y
    file.bind({quarter, quarter});
    const Scene scene = file.load();
    expect_near(shown(scene, 0, 1), {1.5f, 0, 0});
    expect_near(shown(scene, 0, 2), {0, 2, -0.5f});
    // Mirrored: the front, which was counter-clockwise, is so again by the winding.
    const Mesh& mesh = scene.meshes[0];
    const glm::vec3 a = mesh.positions[mesh.indices[0]], b = mesh.positions[mesh.indices[1]],
                    c = mesh.positions[mesh.indices[2]];
    EXPECT_GT(glm::dot(glm::cross(b - a, c - a), mesh.normals[0]), 0.0f);
    expect_near(mesh.normals[0], {0, -1, 0});
}

TEST(GltfRestPose, WeightsThatDoNotAddUpAreScaled) {
    Skinned file;
    file.attributes()["WEIGHTS_0"] = file.add_vectors<4>({{0.5f, 0, 0, 0}, {1, 0, 0, 0}, {0, 0, 0, 0}});
    const Scene scene = file.load();
    expect_near(shown(scene, 0, 0), {1, 0, 0});
    expect_near(shown(scene, 0, 2), {1, 0.5f, 0}); // none at all: the first joint
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_CONTAINS(scene.warnings[0], "joint weights that do not add up to 1");
    EXPECT_CONTAINS(scene.warnings[0], "(2 times)");
}

TEST(GltfRestPose, MoreThanFourJoints) {
    Skinned file;
    file.attributes()["WEIGHTS_0"] = file.add_vectors<4>({{1, 0, 0, 0}, {1, 0, 0, 0}, {0.5f, 0, 0, 0}});
    file.attributes()["JOINTS_1"] =
        file.add<std::uint8_t>(std::vector<int>{1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, 1, 5121);
    file.attributes()["WEIGHTS_1"] = file.add_vectors<4>({{0, 0, 0, 0}, {0, 0, 0, 0}, {0.5f, 0, 0, 0}});
    expect_near(shown(file.load(), 0, 2), {0.5f, 1.5f, 0});
}

TEST(GltfRestPose, BadSkins) {
    const auto error = [](auto&& edit) {
        Skinned file;
        edit(file);
        return testing::sentence(Fault::bad_input, [&] { file.load(); });
    };
    EXPECT_CONTAINS(error([](Skinned& f) { f.json["skins"][0]["joints"] = {2}; }), "joint 1 of a skin of 1");
    EXPECT_CONTAINS(error([](Skinned& f) {
                        f.json["skins"][0]["joints"] = {2, 9};
                    }),
                    "node 9 does not exist");
    EXPECT_CONTAINS(error([](Skinned& f) { f.bind({Matrix{}}); }), "1 matrices for 2 joints");
    EXPECT_CONTAINS(error([](Skinned& f) { f.json["nodes"][0]["skin"] = 1; }), "skin 1 does not exist");
    Skinned plain;
    plain.attributes().erase("JOINTS_0");
    EXPECT_CONTAINS(plain.load().warnings.at(0), "does not follow its skin");
}

} // namespace
} // namespace luxel
