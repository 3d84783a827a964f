// SPDX-License-Identifier: MIT
// Real scenes, and the malformed files of other projects: each loads or ends with one sentence, quickly.
#include <chrono>
#include <fstream>
#include <iostream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "scene/gltf/gltf.h"
#include "scene/mesh_attributes.h"
#include "scene/obj.h"
#include "support/data.h"

namespace luxel {
namespace {

namespace fs = std::filesystem;

Scene load(const fs::path& path) { return path.extension() == ".obj" ? load_obj(path) : load_gltf(path); }

struct Expected {
    const char* file;
    std::size_t triangles, textures, cameras, lights;
};
void PrintTo(const Expected& e, std::ostream* out) { *out << e.file; }

class RealScene : public ::testing::TestWithParam<Expected> {};

TEST_P(RealScene, HasItsTriangles) {
    LUXEL_DATA_OR_SKIP(path, GetParam().file);
    const Scene scene = load(path);
    EXPECT_EQ(scene.triangles(), GetParam().triangles);
    EXPECT_EQ(scene.textures.size(), GetParam().textures);
    EXPECT_EQ(scene.cameras.size(), GetParam().cameras);
    EXPECT_EQ(scene.lights.size(), GetParam().lights);
    // A texture is replaced only where its file is not there.
    for (const std::string& warning : scene.warnings)
        if (warning.find("grey") != std::string::npos) {
            EXPECT_NE(warning.find("no such file"), std::string::npos) << warning;
        }
}

INSTANTIATE_TEST_SUITE_P(, RealScene,
                         ::testing::Values(Expected{"cornell_box/cornell_box.gltf", 36, 0, 1, 0},
                                           Expected{"modern_hall/modern_hall.gltf", 31167, 3, 1, 0},
                                           Expected{"bathroom/bathroom.gltf", 1016615, 2, 1, 0},
                                           Expected{"sponza_crytek/sponza_crytek.gltf", 262267, 40, 3, 1},
                                           Expected{"living_room/living_room.gltf", 143163, 4, 1, 0},
                                           Expected{"dream_apartment/dream_apartment.glb", 177934, 0, 0, 0},
                                           Expected{"japanese_bridge/japanese_bridge.glb", 21883, 0, 0, 0},
                                           Expected{"water_caustic/water_caustic.gltf", 103487, 0, 1, 0},
                                           Expected{"teapot_glass/teapot_glass.gltf", 126744, 1, 1, 1},
                                           Expected{"cornell_box_nvpro/cornellBox.gltf", 16732, 0, 1, 0},
                                           Expected{"cornell_box_obj/cornell_box.obj", 36, 0, 0, 0},
                                           Expected{"models/stanford_dragon/stanford_dragon.gltf", 864374, 0,
                                                    0, 0},
                                           Expected{"models/head_lps/head_lps.glb", 17684, 2, 0, 0}),
                         [](const auto& test) {
                             std::string name = fs::path(test.param.file).parent_path().filename().string();
                             return name;
                         });

// Emitters keep the radiance that the conversion stored, on one side.
TEST(RealSceneContent, CornellBoxEmitsFromOneSide) {
    LUXEL_DATA_OR_SKIP(path, "cornell_box/cornell_box.gltf");
    const Scene scene = load(path);
    int emitters = 0;
    for (const Material& m : scene.materials) {
        if (m.emission == glm::vec3(0)) continue;
        ++emitters;
        EXPECT_FALSE(m.double_sided);
        EXPECT_NEAR(m.emission.r, 17.0f, 1e-3f);
        EXPECT_NEAR(m.emission.g, 12.0f, 1e-3f);
        EXPECT_NEAR(m.emission.b, 4.0f, 1e-3f);
    }
    EXPECT_EQ(emitters, 1);
}

// Meshes whose file stores MikkTSpace tangents of unfolded texture coordinates: ours are the same.
TEST(RealSceneContent, GeneratedTangentsAgreeWithStoredOnes) {
    LUXEL_DATA_OR_SKIP(path, "gltf_materials/ClearCoatTest.glb");
    Scene scene = load(path);
    std::size_t compared = 0;
    for (Mesh& mesh : scene.meshes) {
        const auto stored = mesh.tangents;
        if (stored.empty()) continue;
        make_tangents(mesh, 0, glm::mat3(1.0f));
        for (std::size_t i = 0; i < stored.size(); ++i) {
            ASSERT_GT(glm::dot(glm::vec3(stored[i]), glm::vec3(mesh.tangents[i])), 0.9999f) << i;
            ASSERT_EQ(stored[i].w, mesh.tangents[i].w) << i;
        }
        compared += stored.size();
    }
    EXPECT_EQ(compared, 6u * 1113u);
}

std::vector<fs::path> scenes_below(const fs::path& folder) {
    std::vector<fs::path> found;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        const std::string extension = entry.path().extension().string();
        if (extension == ".gltf" || extension == ".glb" || extension == ".obj") found.push_back(entry.path());
    }
    std::sort(found.begin(), found.end());
    return found;
}

TEST(Robustness, EveryFileLoadsOrEndsWithASentence) {
    LUXEL_DATA_OR_SKIP(folder, "robustness");
    int loaded = 0, refused = 0;
    for (const fs::path& path : scenes_below(folder)) {
        const auto start = std::chrono::steady_clock::now();
        try {
            load(path);
            ++loaded;
        } catch (const Error& error) {
            ++refused;
            EXPECT_TRUE(std::string(error.what()).starts_with(path.string())) << error.what();
        }
        const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
        EXPECT_LT(seconds.count(), 10.0) << path;
    }
    EXPECT_GT(loaded, 40);
    EXPECT_GT(refused, 100);
    std::cout << loaded << " load, " << refused << " are refused\n";
}

// Files with the Khronos validator's verdict beside them. None with an error is shown; a file without errors
// is refused only for having no triangles, or for what this reader does not support. Disagreements are
// printed.
TEST(Robustness, AgreesWithTheValidator) {
    LUXEL_DATA_OR_SKIP(folder, "robustness/gltf_validator");
    int wrong = 0, right = 0, disagreements = 0;
    for (const fs::path& path : scenes_below(folder)) {
        std::ifstream report(path.string() + ".report.json");
        if (!report) continue;
        const auto issues = nlohmann::json::parse(report)["issues"];
        const bool valid = issues["numErrors"] == 0;
        ++(valid ? right : wrong);
        std::string refusal;
        try {
            load(path);
        } catch (const Error& error) {
            refusal = error.what();
        }
        const bool empty = refusal.ends_with("the scene has no triangles");
        if (valid ? refusal.empty() || empty : !refusal.empty()) continue;
        ++disagreements;
        std::cout << path.filename().string() << ": "
                  << (valid ? "valid, but: " + refusal : "shown, but: " + issues["messages"][0].dump())
                  << '\n';
    }
    std::cout << wrong << " files with errors, " << right << " without, " << disagreements
              << " disagreements\n";
    EXPECT_GT(wrong, 50);
    EXPECT_GT(right, 20);
    EXPECT_EQ(disagreements, 0);
}

} // namespace
} // namespace luxel
