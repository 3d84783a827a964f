// SPDX-License-Identifier: MIT
// Which instances are one object.
#include "scene/roles.h"

#include <gtest/gtest.h>

#include "scene/procedural.h"

namespace luxel {
namespace {

Scene scene_with_roles(const std::vector<std::string>& roles) {
    Scene scene;
    Material diffuse;
    diffuse.metallic = 0.0f;
    scene.materials.push_back(diffuse);
    scene.meshes.emplace_back();
    for (const std::string& role : roles) scene.instances.push_back({.name = "thing", .role = role});
    return scene;
}

using Instances = std::vector<int>;

TEST(Roles, GroupInstancesOfTheSameRole) {
    Scene scene = scene_with_roles({"dynamic bunny", "", "enclosure", "dynamic ball", "dynamic bunny"});
    std::vector<SceneObject> objects = dynamic_objects(scene);
    ASSERT_EQ(objects.size(), 2u);
    EXPECT_EQ(objects[0].role, "dynamic bunny");
    EXPECT_EQ(objects[0].instances, (Instances{0, 4}));
    EXPECT_EQ(objects[1].instances, Instances{3});
    EXPECT_EQ(all_but(scene, {objects[0]}), (std::vector<bool>{false, true, true, true, false}));
    EXPECT_EQ(only(scene, {objects[0]}), (std::vector<bool>{true, false, false, false, true}));
    EXPECT_TRUE(specular_objects(scene).empty());
}

TEST(Roles, MaterialsMakeSpecularObjects) {
    Scene scene = scene_with_roles({"", "", "dynamic thing", "specular ring", "specular ring", "", ""});
    Material mirror, rough, glass;
    mirror.roughness = 0.05f, rough.roughness = 0.5f;
    glass.metallic = glass.roughness = 0.0f, glass.transmission = 1.0f;
    for (const Material& m : {mirror, rough, glass}) {
        Mesh mesh;
        mesh.material = int(scene.materials.size());
        scene.materials.push_back(m);
        scene.meshes.push_back(mesh);
    }
    // Diffuse, mirror, mirror with another role, two of a role, rough metal, glass.
    const int meshes[] = {0, 1, 1, 0, 1, 2, 3};
    for (std::size_t i = 0; i < 7; ++i) scene.instances[i].mesh = meshes[i];
    std::vector<SceneObject> objects = specular_objects(scene);
    ASSERT_EQ(objects.size(), 3u);
    EXPECT_EQ(objects[0].instances, Instances{1});
    EXPECT_EQ(objects[1].instances, (Instances{3, 4}));
    EXPECT_EQ(objects[1].role, "specular ring");
    EXPECT_EQ(objects[2].instances, Instances{6});
}

// One tree of two parts, two stones that each have their own, a part with other settings.
TEST(Roles, ImpostorsAreSharedWithinARole) {
    Scene scene = scene_with_roles({"tree", "", "tree", "", "tree", ""});
    const Impostor nailboard{.kind = ImpostorKind::nailboard, .size = 64};
    for (std::size_t i : {0, 2, 3, 5}) scene.instances[i].impostor = nailboard;
    scene.instances[4].impostor = {.kind = ImpostorKind::billboard, .size = 64};
    std::vector<ImpostorObject> objects = impostor_objects(scene);
    ASSERT_EQ(objects.size(), 4u);
    EXPECT_EQ(objects[0].instances, (Instances{0, 2}));
    EXPECT_EQ(objects[0].name, "tree");
    EXPECT_EQ(objects[0].impostor, nailboard);
    EXPECT_EQ(objects[1].instances, Instances{3});
    EXPECT_EQ(objects[1].name, "thing");
    EXPECT_EQ(objects[2].instances, Instances{4});
    EXPECT_EQ(objects[3].instances, Instances{5});
}

} // namespace
} // namespace luxel
