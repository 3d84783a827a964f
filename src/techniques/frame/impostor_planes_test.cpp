// SPDX-License-Identifier: MIT
// Billboard clouds: every triangle has a plane, and no plane has a triangle beyond the distance.
#include "techniques/frame/impostor_planes.h"

#include <random>
#include <set>

#include <gtest/gtest.h>

#include "core/error.h"
#include "scene/procedural.h"
#include "techniques/frame/impostor_cloud.h"

namespace luxel {
namespace {

std::vector<glm::vec3> corners_of(const Mesh& mesh) {
    std::vector<glm::vec3> corners;
    for (std::uint32_t i : mesh.indices) corners.push_back(mesh.positions[i]);
    return corners;
}

std::vector<ImpostorPlane> checked_planes(const Mesh& mesh, float distance) {
    const std::vector<glm::vec3> corners = corners_of(mesh);
    std::vector<ImpostorPlane> planes = choose_planes(corners, distance);
    std::set<std::uint32_t> covered;
    for (const ImpostorPlane& plane : planes) {
        EXPECT_NEAR(glm::length(plane.normal), 1.0f, 1e-5f);
        for (std::uint32_t t : plane.triangles) {
            covered.insert(t);
            for (std::uint32_t k = 0; k < 3; ++k)
                EXPECT_LE(std::abs(glm::dot(plane.normal, corners[3 * t + k]) - plane.offset),
                          distance * 1.001f + 1e-6f);
        }
    }
    for (std::uint32_t t = 0; t < corners.size() / 3; ++t) {
        const float area =
            glm::length(glm::cross(corners[3 * t + 1] - corners[3 * t], corners[3 * t + 2] - corners[3 * t]));
        EXPECT_TRUE(area == 0.0f || covered.contains(t)) << t;
    }
    return planes;
}

TEST(ImpostorPlanes, ABoxHasSix) {
    Mesh box;
    add_box(box, {-1, -2, -3}, {1, 2, 3});
    EXPECT_EQ(checked_planes(box, 0.01f).size(), 6u);
}

// A cap of height 2 e of a ball of radius r has the solid angle 4 pi e / r, so about r / e planes at least.
TEST(ImpostorPlanes, ASphereHasFewerForALargerDistance) {
    Mesh sphere;
    add_sphere(sphere, {3, 1, 2}, 1.0f, 48, 24);
    std::size_t before = 1000;
    for (float distance : {0.02f, 0.05f, 0.1f, 0.2f}) {
        const std::size_t count = checked_planes(sphere, distance).size();
        EXPECT_LT(count, before) << distance;
        EXPECT_GE(float(count), 1.0f / distance) << distance;
        EXPECT_LE(float(count), 6.0f / distance) << distance;
        before = count;
    }
}

// Needles, whose normals single precision cannot tell, and a point.
TEST(ImpostorPlanes, SliversHaveThemToo) {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> unit(-1.0f, 1.0f);
    Mesh needles;
    for (int i = 0; i < 300; ++i) {
        const glm::vec3 a(unit(random), unit(random), unit(random)),
            b(unit(random), unit(random), unit(random));
        const glm::vec3 aside =
            glm::vec3(unit(random), unit(random), unit(random)) * std::pow(10.0f, -float(i % 7));
        for (glm::vec3 p : {a, b, glm::mix(a, b, 0.3f) + aside}) {
            needles.indices.push_back(std::uint32_t(needles.positions.size()));
            needles.positions.push_back(p);
        }
    }
    needles.indices.insert(needles.indices.end(), {0, 0, 0});
    EXPECT_GT(checked_planes(needles, 1e-3f).size(), 50u);
    EXPECT_LT(checked_planes(needles, 0.3f).size(), 50u);
}

TEST(ImpostorPlanes, LeavesShareThem) {
    const Scene scene = tree();
    const Mesh& leaves = scene.meshes[2];
    const std::size_t quads = leaves.indices.size() / 6;
    EXPECT_LE(checked_planes(leaves, 1e-4f).size(), quads);
    EXPECT_LT(checked_planes(leaves, 0.05f).size(), quads / 4);
}

TEST(ImpostorCloud, CardsAreApartAndHoldTheirTriangles) {
    Scene scene = tree();
    const ImpostorObject object{
        "leaves", {.kind = ImpostorKind::billboard_cloud, .size = 64, .distance = 0.05f}, {2, 3}};
    const ImpostorCloud cloud = make_cloud(scene, object);
    ASSERT_FALSE(cloud.cards.empty());
    std::vector<bool> taken(std::size_t(cloud.width) * cloud.height);
    for (std::size_t i = 0; i < cloud.cards.size(); ++i) {
        const shared::ImpostorCard& card = cloud.cards[i];
        for (int y = int(card.first.y); y < int(card.first.y + card.size.y); ++y)
            for (int x = int(card.first.x); x < int(card.first.x + card.size.x); ++x) {
                const std::size_t texel = std::size_t(y) * cloud.width + std::size_t(x);
                ASSERT_FALSE(taken.at(texel)) << i;
                taken[texel] = true;
            }

        // A corner's place in the image is that in the card.
        for (const ImpostorCloud::Part& part : cloud.parts[i]) {
            const Mesh& mesh = scene.meshes[std::size_t(scene.instances[std::size_t(part.instance)].mesh)];
            for (std::uint32_t k = 0; k < part.count; ++k) {
                const glm::vec3 p = mesh.positions[cloud.indices[part.first + k]];
                const glm::vec4 clip = cloud.views[i].world_to_clip * glm::vec4(p, 1.0f);
                const glm::vec2 texel((0.5f + 0.5f * clip.x) * float(cloud.width),
                                      (0.5f - 0.5f * clip.y) * float(cloud.height));
                const glm::vec3 from = p - card.corner;
                const glm::vec2 in_card(glm::dot(from, card.edge_u) / glm::dot(card.edge_u, card.edge_u),
                                        glm::dot(from, card.edge_v) / glm::dot(card.edge_v, card.edge_v));
                ASSERT_LT(glm::length(texel - (card.first + card.size * in_card)), 0.01f);
                ASSERT_TRUE(glm::all(glm::greaterThan(in_card * card.size, glm::vec2(0.9f))) &&
                            glm::all(glm::lessThan(in_card * card.size, card.size - 0.9f)));
                ASSERT_TRUE(clip.z >= 0.0f && clip.z <= 1.0f) << clip.z;
            }
        }
    }
}

TEST(ImpostorCloud, RefusesWhatItCannotShow) {
    const auto error_of = [](const Scene& scene, const Impostor& impostor) -> std::string {
        try {
            make_cloud(scene, {"thing", impostor, {0}});
        } catch (const Error& error) {
            return error.what();
        }
        return "";
    };
    const Impostor cloud{.kind = ImpostorKind::billboard_cloud, .distance = 0.05f};
    EXPECT_EQ(error_of(relief(), cloud),
              "relief: object \"thing\": a billboard_cloud cannot show a height map; make it a nailboard");
    Impostor fine = cloud;
    fine.distance = 1e-6f;
    EXPECT_NE(error_of(tree(), fine).find("too small"), std::string::npos);
    Impostor large = cloud;
    large.size = 100000;
    EXPECT_NE(error_of(tree(), large).find("lower impostor_size"), std::string::npos);
    EXPECT_EQ(error_of(tree(), cloud), "");
}

} // namespace
} // namespace luxel
