// SPDX-License-Identifier: MIT
// Dispatch by prefix and extension, stated defaults, and one sentence for what is not supported.
#include "scene/load.h"

#include <algorithm>
#include <fstream>

#include <gtest/gtest.h>

#include "core/error.h"
#include "scene/environment.h"
#include "scene/gltf/test_gltf.h"
#include "scene/validate.h"
#include "support/build_folders.h"
#include "support/data.h"

namespace luxel {
namespace {

TEST(Load, EveryBuiltinSceneIsValidAndNeedsNoDefaults) {
    for (const BuiltinScene& entry : builtin_scenes()) {
        const Scene scene = load_scene("builtin:" + entry.name);
        EXPECT_TRUE(scene.warnings.empty()) << entry.name;
        EXPECT_FALSE(scene.cameras.empty()) << entry.name;
    }
}

TEST(Load, UnknownExtensionListsTheSupportedOnes) {
    for (const char* source : {"scene.fbx", "scene", "", "BUILTIN:cornell", "folder.gltf/scene"}) {
        try {
            load_scene(source);
            FAIL() << source;
        } catch (const Error& error) {
            EXPECT_EQ(error.fault(), Fault::bad_input);
            EXPECT_NE(std::string(error.what()).find(".gltf, .glb, .obj, .toml and builtin:NAME"),
                      std::string::npos);
        }
    }
}

TEST(Load, EnvironmentCanBeReplaced) {
    const Scene sky = load_scene("builtin:cornell", {.environment = "sky", .environment_scale = 2.0f});
    EXPECT_NEAR(evaluate(sky.environment, {0, 1, 0}).b, 1.8f, 0.02f);
    try {
        load_scene("builtin:cornell", {.environment = "absent.hdr"});
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.fault(), Fault::io);
        EXPECT_NE(std::string(error.what()).find("absent.hdr"), std::string::npos);
    }
}

// An OBJ has neither cameras nor a light unless a material emits; its extension may be in capitals.
TEST(Load, StatesItsDefaults) {
    const std::filesystem::path folder = std::filesystem::path(LUXEL_BINARY_DIR) / "load_test";
    std::filesystem::create_directories(folder);
    std::ofstream(folder / "BARE.OBJ") << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    const Scene scene = load_scene((folder / "BARE.OBJ").string());
    std::filesystem::remove_all(folder);

    EXPECT_EQ(scene.cameras.size(), 3u);
    EXPECT_FALSE(EnvironmentSampler(scene.environment).empty());
    ASSERT_EQ(scene.warnings.size(), 2u);
    EXPECT_NE(scene.warnings[0].find("no camera"), std::string::npos);
    EXPECT_NE(scene.warnings[1].find("no light"), std::string::npos);
    EXPECT_NO_THROW(validate_scene(scene, "completed"));
}

// The procedural Cornell box is the published one: same triangles up to the table's rounding.
TEST(Load, BuiltinCornellEqualsThePublishedScene) {
    LUXEL_DATA_OR_SKIP(path, "cornell_box/cornell_box.gltf");
    const Scene file = load_scene(path.string()), made = load_scene("builtin:cornell");
    EXPECT_TRUE(file.warnings.empty());

    struct Corner {
        glm::vec3 position, color, emission;
    };
    const auto corners = [](const Scene& scene) {
        std::vector<Corner> all;
        for (const Instance& instance : scene.instances) {
            const Mesh& mesh = scene.meshes[std::size_t(instance.mesh)];
            const Material& m = scene.materials[std::size_t(mesh.material)];
            for (const std::uint32_t i : mesh.indices)
                all.push_back({glm::vec3(instance.transform * glm::vec4(mesh.positions[i], 1.0f)),
                               glm::vec3(m.base_color), m.emission});
        }
        return all;
    };
    const std::vector<Corner> a = corners(file), b = corners(made);
    ASSERT_EQ(a.size(), b.size());
    for (const auto& [from, to] : {std::pair(a, b), std::pair(b, a)})
        for (const Corner& p : from) {
            float nearest = 1e9f;
            for (const Corner& q : to)
                nearest =
                    std::min(nearest, glm::length(p.position - q.position) + glm::length(p.color - q.color) +
                                          glm::length(p.emission - q.emission));
            EXPECT_LT(nearest, 2e-5f);
        }

    // The published angle is 19.5 degrees to its rounding.
    EXPECT_LT(glm::length(file.cameras[0].position - made.cameras[0].position), 1e-6f);
    EXPECT_LT(glm::length(file.cameras[0].forward - made.cameras[0].forward), 1e-6f);
    EXPECT_NEAR(file.cameras[0].yfov, made.cameras[0].yfov, 1e-4f);
}

// Blender's "standard" mode: 1000 W become 54351 cd, while what glows keeps its watts.
TEST(Load, LampsThatOutshineEverythingAreWarnedOf) {
    testing::TestGltf file;
    file.material()["emissiveFactor"] = {1, 1, 1};
    file.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}, {"intensity", 54351}}};
    file.json["nodes"].push_back({{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    file.json["nodes"].push_back({{"mesh", 0}, {"translation", {0, 0, 10}}});
    file.json["scenes"][0]["nodes"] = {0, 1, 2};
    const std::string path = file.save().string();
    const auto warned = [](const Scene& scene) {
        return std::any_of(scene.warnings.begin(), scene.warnings.end(), [](const std::string& w) {
            return w.find("--lights watts") != std::string::npos;
        });
    };
    EXPECT_TRUE(warned(load_scene(path)));
    const Scene scene = load_scene(path, {.lights = LightUnits::watts});
    EXPECT_FALSE(warned(scene));
    EXPECT_FLOAT_EQ(scene.lights[0].intensity.x, 54351.0f / 683.0f);
}

} // namespace
} // namespace luxel
