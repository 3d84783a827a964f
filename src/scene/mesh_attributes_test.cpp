// SPDX-License-Identifier: MIT
#include "scene/mesh_attributes.h"

#include <gtest/gtest.h>

namespace luxel {
namespace {

// A fold: two triangles that share the edge from 0 to 1 at a right angle.
Mesh fold() {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 2}};
    mesh.indices = {0, 1, 2, 1, 0, 3};
    return mesh;
}

TEST(MeshAttributes, FlatNormalsAreNotShared) {
    Mesh mesh = fold();
    mesh.colors = {{1, 0, 0, 1}, {0, 1, 0, 1}, {0, 0, 1, 1}, {1, 1, 1, 1}};
    make_flat(mesh);
    ASSERT_EQ(mesh.positions.size(), 6u);
    EXPECT_EQ(mesh.indices, (std::vector<std::uint32_t>{0, 1, 2, 3, 4, 5}));
    EXPECT_EQ(mesh.normals[0], glm::vec3(0, 0, 1));
    EXPECT_EQ(mesh.normals[3], glm::vec3(0, 1, 0));
    EXPECT_EQ(mesh.colors[5], glm::vec4(1));
}

TEST(MeshAttributes, BrokenNormalsBecomeTheMeanOfTheirFaces) {
    Mesh mesh = fold();
    mesh.normals = {{0, 0, 0}, {0, 0, 0}, {0, 0, 7}, {0, 1e-30f, 0}};
    repair_normals(mesh);
    // The second face has twice the area of the first.
    const glm::vec3 mean = glm::normalize(glm::vec3(0, 2, 1));
    EXPECT_LT(glm::length(mesh.normals[0] - mean), 1e-6f);
    EXPECT_LT(glm::length(mesh.normals[1] - mean), 1e-6f);
    EXPECT_EQ(mesh.normals[2], glm::vec3(0, 0, 1));
    EXPECT_EQ(mesh.normals[3], glm::vec3(0, 1, 0));
}

TEST(MeshAttributes, DegenerateTrianglesGetAUnitNormal) {
    Mesh mesh;
    mesh.positions = {{1, 1, 1}, {1, 1, 1}, {2, 2, 2}};
    mesh.indices = {0, 1, 2};
    make_flat(mesh);
    EXPECT_FLOAT_EQ(glm::length(mesh.normals[0]), 1.0f);
}

TEST(MeshAttributes, TangentsFollowTheTextureAndAreOrthogonal) {
    Mesh mesh = fold();
    mesh.indices = {0, 1, 2};
    mesh.normals.assign(4, glm::normalize(glm::vec3(0.3f, 0, 1)));
    mesh.texcoords[1] = {{0, 1}, {1, 1}, {0, 0}, {0, 0}};
    make_tangents(mesh, 1, glm::mat3(1.0f));
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_NEAR(glm::dot(glm::vec3(mesh.tangents[i]), mesh.normals[i]), 0.0f, 1e-6f);
        EXPECT_GT(mesh.tangents[i].x, 0.9f);
        EXPECT_EQ(mesh.tangents[i].w, 1.0f); // v runs down: cross(n, t) is the texture's up
    }

    // Mirrored texture: u runs along -x.
    mesh.texcoords[1] = {{0, 1}, {-1, 1}, {0, 0}, {0, 0}};
    make_tangents(mesh, 1, glm::mat3(1.0f));
    EXPECT_LT(mesh.tangents[0].x, -0.9f);
    EXPECT_EQ(mesh.tangents[0].w, -1.0f);

    // The transform's axes count: scaled by -1 in u, it is as before.
    make_tangents(mesh, 1, glm::mat3(-1, 0, 0, 0, 1, 0, 0, 0, 1));
    EXPECT_GT(mesh.tangents[0].x, 0.9f);
}

// Two quads that share two vertices; the texture is mirrored along the shared edge, or is not.
Mesh folded_texture(glm::vec2 last) {
    Mesh mesh;
    mesh.positions = {{-1, 0, 0}, {-1, 1, 0}, {0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}};
    mesh.indices = {0, 2, 1, 1, 2, 3, 2, 4, 3, 3, 4, 5};
    mesh.normals.assign(6, glm::vec3(0, 0, 1));
    mesh.texcoords[0] = {{0, 1}, {0, 0}, {1, 1}, {1, 0}, last, last - glm::vec2(0, 1)};
    return mesh;
}

TEST(MeshAttributes, TangentsOfMirroredTexturesDoNotMix) {
    Mesh straight = folded_texture({2, 1});
    make_tangents(straight, 0, glm::mat3(1.0f));
    EXPECT_EQ(straight.positions.size(), 6u);
    for (const glm::vec4& t : straight.tangents) EXPECT_EQ(t, glm::vec4(1, 0, 0, 1));

    for (const bool in_v : {false, true}) {
        Mesh mesh = folded_texture({0, 1});
        if (in_v)
            for (glm::vec2& uv : mesh.texcoords[0]) uv = {uv.y, uv.x};
        make_tangents(mesh, 0, glm::mat3(1.0f));
        EXPECT_EQ(mesh.positions.size(), 8u); // the two on the edge are split
        ASSERT_EQ(mesh.texcoords[0].size(), 8u);
        for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
            const bool left = i < 6;
            const glm::vec3 u = in_v ? glm::vec3(0, -1, 0) : glm::vec3(left ? 1 : -1, 0, 0);
            const glm::vec4 t = mesh.tangents[mesh.indices[i]];
            EXPECT_EQ(glm::vec3(t), u) << i;
            EXPECT_EQ(t.w, in_v ? (left ? -1.0f : 1.0f) : (left ? 1.0f : -1.0f)) << i;
        }
    }
}

// Angles count, not areas: a long thin face beside a small one.
TEST(MeshAttributes, TangentsAreWeightedByAngles) {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-100, 0, 0}};
    mesh.indices = {0, 1, 2, 0, 2, 3};
    mesh.normals.assign(4, glm::vec3(0, 0, 1));
    // +u is +x on the first face, and 45 degrees off on the second.
    mesh.texcoords[0] = {{0, 0}, {1, 0}, {0, -1}, {-100, -100}};
    make_tangents(mesh, 0, glm::mat3(1.0f));
    // Both faces have a right angle at vertex 0: the mean of the two directions.
    const glm::vec3 own = glm::vec3(mesh.tangents[3]), mean = glm::normalize(glm::vec3(1, 0, 0) + own);
    EXPECT_LT(glm::length(glm::vec3(mesh.tangents[0]) - mean), 1e-6f);
    EXPECT_GT(glm::length(own - glm::vec3(1, 0, 0)), 0.3f);
}

TEST(MeshAttributes, TangentsExistWithoutTextureCoordinates) {
    Mesh mesh = fold();
    mesh.normals.assign(4, glm::vec3(1, 0, 0));
    make_tangents(mesh, 0, glm::mat3(1.0f));
    for (const glm::vec4& t : mesh.tangents) {
        EXPECT_FLOAT_EQ(glm::length(glm::vec3(t)), 1.0f);
        EXPECT_FLOAT_EQ(t.x, 0.0f);
    }
}

TEST(MeshAttributes, DropsUnusedVerticesOnly) {
    Mesh mesh = fold();
    mesh.indices = {3, 1, 0};
    mesh.normals = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}};
    drop_unused_vertices(mesh);
    EXPECT_EQ(mesh.indices, (std::vector<std::uint32_t>{0, 1, 2}));
    EXPECT_EQ(mesh.positions, (std::vector<glm::vec3>{{0, 0, 2}, {1, 0, 0}, {0, 0, 0}}));
    EXPECT_EQ(mesh.normals[0], glm::vec3(-1, 0, 0));

    Mesh whole = fold();
    drop_unused_vertices(whole);
    EXPECT_EQ(whole.indices, fold().indices);
    EXPECT_EQ(whole.positions, fold().positions);
}

} // namespace
} // namespace luxel
