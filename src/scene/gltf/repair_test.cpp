// SPDX-License-Identifier: MIT
// Single bad values are mended or left out, with a warning that counts them.
#include <limits>

#include "scene/gltf/test_gltf.h"

namespace luxel {
namespace {

using testing::TestGltf;

constexpr float nan = std::numeric_limits<float>::quiet_NaN();

// Two triangles, the second of vertices 3 to 5.
struct Pair : TestGltf {
    Pair() {
        attributes()["POSITION"] =
            add_vectors<3>({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {2, 0, 0}, {3, 0, 0}, {2, 1, 0}});
    }
    void set_position(std::size_t vertex, glm::vec3 p) {
        std::memcpy(bytes.data() + 36 + 12 * vertex, &p, sizeof p); // behind TestGltf's own triangle
    }
};

void expect_warning(const Scene& scene, const char* part) {
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_CONTAINS(scene.warnings[0], part);
}

TEST(GltfRepair, TrianglesOfBadPositionsGo) {
    for (const float bad : {nan, std::numeric_limits<float>::infinity()}) {
        Pair file;
        file.set_position(4, {1, bad, 0});
        const Scene scene = file.load();
        EXPECT_EQ(scene.triangles(), 1u);
        for (const glm::vec3& p : scene.meshes[0].positions) EXPECT_LT(glm::length(p), 10.0f);
        expect_warning(scene, "triangles with a position that is not finite are left out");
    }
}

TEST(GltfRepair, TrianglesWithoutAreaDoNoHarm) {
    Pair file;
    file.set_position(4, {2, 0.5f, 0});
    const Scene scene = file.load();
    EXPECT_EQ(scene.triangles(), 2u);
    EXPECT_TRUE(scene.warnings.empty());
}

TEST(GltfRepair, BadNormalsAreThoseOfTheFaces) {
    const float inf = std::numeric_limits<float>::infinity();
    for (const glm::vec3 bad : {glm::vec3(0.0f), glm::vec3(nan, 0, 1), glm::vec3(0, inf, 0)}) {
        TestGltf file;
        file.attributes()["NORMAL"] = file.add_vectors<3>({{0, 0.6f, 0.8f}, bad, {0, 0, 1}});
        const Scene scene = file.load();
        EXPECT_EQ(scene.meshes[0].normals[1], glm::vec3(0, 0, 1));
        EXPECT_NEAR(scene.meshes[0].normals[0].y, 0.6f, 1e-6f);
        expect_warning(scene, "normals that are not finite or of no length");
    }
}

TEST(GltfRepair, OtherAttributes) {
    TestGltf file;
    file.attributes()["NORMAL"] = file.add_vectors<3>({{0, 0, 1}, {0, 0, 1}, {0, 0, 1}});
    file.attributes()["TANGENT"] = file.add_vectors<4>({{1, 0, 0, 1}, {nan, 0, 0, 1}, {1, 0, 0, 1}});
    expect_warning(file.load(), "tangents that are not finite");

    TestGltf colors;
    colors.attributes()["COLOR_0"] = colors.add_vectors<4>({{1, 0, 0, 1}, {nan, 0, 0, 1}, {nan, 0, nan, 1}});
    const Scene scene = colors.load();
    EXPECT_EQ(scene.meshes[0].colors[1], glm::vec4(1.0f));
    expect_warning(scene, "vertex colors that are not finite are replaced by white (2 times)");

    TestGltf uvs;
    uvs.attributes()["TEXCOORD_0"] = uvs.add_vectors<2>({{1, 0}, {nan, 0}, {1, 1}});
    EXPECT_EQ(uvs.load().meshes[0].texcoords[0][1], glm::vec2(0.0f));
}

} // namespace
} // namespace luxel
