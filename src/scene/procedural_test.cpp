// SPDX-License-Identifier: MIT
// Procedural geometry: known areas and volumes, consistent winding, subdivision, the scenes by name.
#include "scene/procedural.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include <gtest/gtest.h>

#include "core/error.h"
#include "scene/load.h"
#include "scene/procedural_builtin.h"

namespace luxel {
namespace {

constexpr double pi = 3.14159265358979;

struct Measures {
    double area = 0, volume = 0; // volume is positive where the front faces outward
    float worst_agreement = 1;   // least cosine of a vertex normal to its face's
};

Measures measure(const Mesh& mesh) {
    Measures m;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const std::uint32_t* t = &mesh.indices[i];
        const glm::vec3 a = mesh.positions[t[0]], b = mesh.positions[t[1]], c = mesh.positions[t[2]];
        const glm::vec3 cross = glm::cross(b - a, c - a);
        m.area += 0.5 * double(glm::length(cross));
        m.volume += double(glm::dot(a, glm::cross(b, c))) / 6.0;
        for (int k = 0; k < 3; ++k)
            m.worst_agreement =
                std::min(m.worst_agreement, glm::dot(mesh.normals[t[k]], glm::normalize(cross)));
    }
    return m;
}

// Edges that are not walked once each way; positions count as equal within some 1e-5.
int open_edges(const Mesh& mesh) {
    using Point = std::array<long, 3>;
    std::map<std::pair<Point, Point>, int> balance;
    const auto point = [&](std::uint32_t i) {
        const glm::vec3 p = mesh.positions[i] * 1e5f;
        return Point{std::lround(p.x), std::lround(p.y), std::lround(p.z)};
    };
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
        for (std::size_t k = 0; k < 3; ++k) {
            const Point a = point(mesh.indices[i + k]), b = point(mesh.indices[i + (k + 1) % 3]);
            balance[std::minmax(a, b)] += a < b ? 1 : a == b ? 0 : -1;
        }
    int open = 0;
    for (const auto& [edge, sum] : balance) open += sum != 0;
    return open;
}

TEST(Procedural, SolidsHaveTheirVolumeAndFaceOutward) {
    Mesh box, sphere, cylinder, cone, torus;
    add_box(box, {-1, 0, 2}, {1, 3, 2.5f});
    add_sphere(sphere, {3, 1, 0}, 0.5f, 128, 64);
    add_cylinder(cylinder, {1, 2, 3}, 0.5f, 2.0f, 128);
    add_cone(cone, {1, 2, 3}, 0.5f, 2.0f, 128);
    add_torus(torus, {0, 1, 0}, 1.0f, 0.25f, 128, 64);

    // The inscribed polyhedra lose of the order of (2 pi / slices)^2 / 6 = 4e-4 of the round solids' volume.
    EXPECT_NEAR(measure(box).volume, 3.0, 1e-5);
    EXPECT_NEAR(measure(sphere).volume / (4.0 / 3.0 * pi * 0.125), 1.0, 2e-3);
    EXPECT_NEAR(measure(cylinder).volume / (pi * 0.25 * 2.0), 1.0, 1e-3);
    EXPECT_NEAR(measure(cone).volume / (pi * 0.25 * 2.0 / 3.0), 1.0, 1e-3);
    EXPECT_NEAR(measure(torus).volume / (2.0 * pi * pi * 1.0 * 0.0625), 1.0, 4e-3);
    for (const Mesh* mesh : {&box, &sphere, &cylinder, &cone, &torus}) {
        EXPECT_GT(measure(*mesh).worst_agreement, 0.99f);
        EXPECT_EQ(mesh->texcoords[0].size(), mesh->positions.size());
    }
}

TEST(Procedural, FurnaceIsClosedAndFacesInward) {
    const Scene scene = furnace(0.5f, 3.0f);
    const Measures m = measure(scene.meshes[0]);
    EXPECT_NEAR(m.volume, -8.0, 1e-5);
    EXPECT_NEAR(m.area, 24.0, 1e-5);
    EXPECT_GT(m.worst_agreement, 0.999f);
    EXPECT_EQ(scene.materials[0].emission, glm::vec3(3.0f));
}

TEST(Procedural, CornellHasItsDimensions) {
    const Scene scene = cornell();
    EXPECT_EQ(scene.triangles(), 36u);
    const Bounds bounds = scene.bounds();
    EXPECT_LT(glm::length(bounds.least - glm::vec3(-1, 0, -1)), 1e-5f);
    EXPECT_LT(glm::length(bounds.most - glm::vec3(1, 2, 1)), 1e-5f);
    for (const Instance& instance : scene.instances) {
        const Mesh& mesh = scene.meshes[std::size_t(instance.mesh)];
        const Measures m = measure(mesh);
        EXPECT_GT(m.worst_agreement, 0.999f) << instance.name;

        // Both boxes have a base of .6 m x .6 m to the rounding of the table, and heights of .6 and 1.2 m.
        if (instance.name == "short box") {
            EXPECT_NEAR(m.volume, 0.36 * 0.6, 0.01);
        }
        if (instance.name == "tall box") {
            EXPECT_NEAR(m.volume, 0.36 * 1.2, 0.02);
        }

        // The room and the lamp face its middle.
        const glm::vec3 toward_middle = glm::vec3(0, 1, 0) - mesh.positions[0];
        if (mesh.indices.size() == 6) {
            EXPECT_GT(glm::dot(mesh.normals[0], toward_middle), 0.0f) << instance.name;
        }
    }
}

TEST(Procedural, SubdivisionKeepsTheSurface) {
    Scene coarse = shapes(ShapesLight::point);
    for (Mesh& mesh : coarse.meshes) {
        mesh.tangents.assign(mesh.positions.size(), glm::vec4(1, 0, 0, -1));
        mesh.texcoords[1] = mesh.texcoords[0];
        mesh.colors.assign(mesh.positions.size(), glm::vec4(0.25f));
    }
    const Scene fine = subdivide(coarse, 2);
    EXPECT_EQ(fine.triangles(), 16 * coarse.triangles());
    for (std::size_t i = 0; i < fine.meshes.size(); ++i) {
        const Mesh &a = coarse.meshes[i], &b = fine.meshes[i];
        const Measures ma = measure(a), mb = measure(b);
        EXPECT_NEAR(ma.area, mb.area, 1e-4 * ma.area);
        EXPECT_NEAR(ma.volume, mb.volume, 1e-4 * (1.0 + std::abs(ma.volume)));
        for (const std::size_t size : {b.normals.size(), b.tangents.size(), b.texcoords[0].size(),
                                       b.texcoords[1].size(), b.colors.size()})
            EXPECT_EQ(size, b.positions.size());
        for (const glm::vec3& n : b.normals) EXPECT_NEAR(glm::length(n), 1.0f, 1e-5f);
        for (const glm::vec4& t : b.tangents) EXPECT_EQ(t, glm::vec4(1, 0, 0, -1));
        for (const glm::vec4& c : b.colors) EXPECT_EQ(c, glm::vec4(0.25f));
    }
}

TEST(Procedural, SubdivisionInterpolatesTextureCoordinates) {
    Scene scene;
    scene.meshes.emplace_back();
    scene.instances.emplace_back();
    add_quad(scene.meshes[0], {0, 0, 0}, {2, 0, 0}, {0, 4, 0});
    const Mesh fine = subdivide(scene, 3).meshes[0];
    EXPECT_EQ(fine.positions.size(), 81u); // shared midpoints: (2^3 + 1)^2
    for (std::size_t i = 0; i < fine.positions.size(); ++i) {
        EXPECT_FLOAT_EQ(fine.texcoords[0][i].x, fine.positions[i].x / 2);
        EXPECT_FLOAT_EQ(fine.texcoords[0][i].y, fine.positions[i].y / 4);
    }
}

// Light is refracted rightly only by solids whose fronts all face outward.
TEST(Procedural, SpecularObjectsAreClosedSolids) {
    for (const Scene& scene : {glass_sphere(), metal_ring(), glass_metal(), mirror_box(), teapot_box(),
                               ring(), occluded_ring(), bunnies_ring()}) {
        int count = 0;
        for (const Instance& instance : scene.instances) {
            if (instance.role != "specular " + instance.name) continue;
            ++count;
            const Mesh& mesh = scene.meshes[std::size_t(instance.mesh)];
            const Measures m = measure(mesh);
            EXPECT_GT(m.volume, 0.0) << instance.name;
            EXPECT_GT(m.worst_agreement, 0.9f) << instance.name;
            if (instance.name == "ring" && scene.name == "metal-ring") {
                EXPECT_NEAR(m.volume / (pi * (0.53 * 0.53 - 0.25) * 0.3), 1.0, 1e-3);
            }

            EXPECT_EQ(open_edges(mesh), 0) << instance.name;
        }
        EXPECT_GT(count, 0) << scene.name;
    }
}

TEST(Procedural, OutlinesPassThroughTheirPoints) {
    const std::vector<OutlinePoint> outline = smooth_outline({{0, 0}, {1, 0.5f}, {1, 1.5f}, {0, 2}}, 8);
    ASSERT_EQ(outline.size(), 25u);
    EXPECT_FLOAT_EQ(outline[8].radius, 1.0f);
    EXPECT_FLOAT_EQ(outline[16].height, 1.5f);
    EXPECT_FLOAT_EQ(outline[12].normal_radial, 1.0f) << "symmetric, so upright halfway";
    EXPECT_EQ(outline[24].radius, 0.0f);
    EXPECT_EQ(outline[24].normal_y, 1.0f);
}

// The normals that waves are given are those of their heights, and time moves them.
TEST(Procedural, WaterHasTheNormalsOfItsWaves) {
    const auto surface = [](const Scene& scene) {
        for (const Instance& instance : scene.instances)
            if (instance.role == "specular water") return scene.meshes[std::size_t(instance.mesh)];
        return Mesh();
    };
    const Mesh at_rest = surface(water(0.0f)), later = surface(water(0.25f));
    const Measures m = measure(at_rest);
    EXPECT_GT(m.worst_agreement, 0.995f);
    EXPECT_GT(m.area, 4.05);
    EXPECT_LT(m.area, 4.5);
    ASSERT_EQ(at_rest.positions.size(), later.positions.size());
    EXPECT_NE(at_rest.positions, later.positions);
}

// [Le2014, chapter 4]; the solids stand for bunnies of one triangle less.
TEST(Procedural, PhotonScenesHaveTheTrianglesOfTheThesis) {
    EXPECT_EQ(ring().triangles(), 202u);
    EXPECT_EQ(occluded_ring().triangles(), 214u);
    EXPECT_EQ(bunnies_ring().triangles(), 208619u + 3u);
    EXPECT_EQ(water_room(0.0f).triangles(), 1932u);
    for (const Scene& scene : {ring(), occluded_ring(), bunnies_ring(), water_room(0.0f)}) {
        ASSERT_EQ(scene.lights.size(), 1u);
        EXPECT_EQ(scene.lights[0].type, shared::LIGHT_SPOT) << scene.name;
    }
}

// Timings compare the same silhouettes in 64 times the triangles.
TEST(Procedural, FineRingHasTheSurfaceOfTheRing) {
    const Scene coarse = ring(), fine = builtin_scene("ring-x64");
    EXPECT_EQ(fine.triangles(), 64u * coarse.triangles());
    for (std::size_t i = 0; i < coarse.meshes.size(); ++i) {
        const Measures a = measure(coarse.meshes[i]), b = measure(fine.meshes[i]);
        EXPECT_NEAR(a.area, b.area, 1e-4 * a.area);
        EXPECT_NEAR(a.volume, b.volume, 1e-4 * (1.0 + std::abs(a.volume)));
    }
}

TEST(Procedural, BunniesAreClosedSolidsThatStandOnTheFloor) {
    int bunnies = 0;
    const Scene scene = bunnies_ring();
    for (const Instance& instance : scene.instances) {
        if (instance.name != "bunny") continue;
        ++bunnies;
        const Mesh& mesh = scene.meshes[std::size_t(instance.mesh)];
        EXPECT_EQ(mesh.indices.size(), 3u * 69452u);
        EXPECT_EQ(open_edges(mesh), 0);
        EXPECT_GT(measure(mesh).volume, 4.0 / 3.0 * pi * 0.19 * 0.19 * 0.19) << "more than the body alone";
        EXPECT_GT(measure(mesh).worst_agreement, 0.9f);
        for (const glm::vec3& p : mesh.positions) EXPECT_GT(p.y, -0.06f);
    }
    EXPECT_EQ(bunnies, 3);
}

TEST(Procedural, MovingScenesTakeAnyTime) {
    const auto surface = [](const std::string& name) {
        const Scene scene = builtin_scene(name);
        for (const Instance& instance : scene.instances)
            if (instance.role == "specular water") return scene.meshes[std::size_t(instance.mesh)].positions;
        return std::vector<glm::vec3>();
    };
    for (const std::string base : {"water", "water-room", "pool"}) {
        EXPECT_EQ(surface(base), surface(base + "-0"));
        EXPECT_NE(surface(base), surface(base + "-0.3"));
        EXPECT_NE(surface(base + "-0.3"), surface(base + "-12.75"));
        EXPECT_TRUE(is_builtin_scene(base + "-12.75-x4"));
        for (const char* wrong : {"-", "--1", "-nan", "-1s", "-1e9"})
            EXPECT_FALSE(is_builtin_scene(base + wrong)) << wrong;
    }
    EXPECT_FALSE(is_builtin_scene("cornell-1"));
}

TEST(Procedural, EveryListedNameLoads) {
    std::set<std::string> names;
    for (const BuiltinScene& entry : builtin_scenes()) {
        const Scene scene = builtin_scene(entry.name);
        EXPECT_EQ(scene.name, entry.name);
        EXPECT_GT(scene.triangles(), 0u);
        EXPECT_FALSE(scene.cameras.empty());
        EXPECT_TRUE(names.insert(entry.name).second) << entry.name;
    }
    EXPECT_EQ(builtin_scene("furnace-0.8").materials[0].base_color.r, 0.8f);
    EXPECT_EQ(builtin_scene("cornell-x16").triangles(), 36u * 16u);
    EXPECT_EQ(builtin_scene("furnace-0.9-x4").triangles(), 48u);
}

TEST(Procedural, UnknownNameListsTheKnownOnes) {
    try {
        builtin_scene("cornel");
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.fault(), Fault::bad_input);
        EXPECT_NE(std::string(error.what()).find("sphere-in-box"), std::string::npos);
    }
}

} // namespace
} // namespace luxel
