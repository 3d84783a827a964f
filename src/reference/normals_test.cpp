// SPDX-License-Identifier: MIT
// Shading normals far from the geometric ones: white surfaces in white light stay white.
#include <gtest/gtest.h>

#include "reference/test_scenes.h"

namespace luxel {
namespace {

using namespace testing;

Material white_metal(float roughness) {
    Material m;
    m.roughness = roughness;
    return m;
}

// A floor whose normal map says the same normal everywhere: of that slope, toward an azimuth.
void add_mapped_floor(Scene& scene, Material material, float slope, float azimuth) {
    const glm::vec3 n = glm::normalize(glm::vec3(slope * std::cos(azimuth), slope * std::sin(azimuth), 1.0f));
    Texture map;
    map.pixels = {.width = 1, .height = 1, .rgba = {}};
    for (int c = 0; c < 3; ++c) map.pixels.rgba.push_back(std::uint8_t(std::lround(127.5f + 127.5f * n[c])));
    map.pixels.rgba.push_back(255);
    material.normal_texture.texture = int(scene.textures.size());
    scene.textures.push_back(map);
    add_floor(scene, material);
    Mesh& mesh = scene.meshes.back();
    mesh.texcoords[0].assign(mesh.positions.size(), glm::vec2(0.0f));
    mesh.tangents.assign(mesh.positions.size(), glm::vec4(1, 0, 0, 1));
}

Measured shown(const Scene& scene, glm::vec3 eye, int spp) {
    RayCaster rays(scene);
    return measure(render_reference(rays, request_for({"full"}, camera_on(eye, {0, 0, 0}), 8, spp)), "full");
}

// One figure for each slope and material, of several azimuths and views, so that its noise is far below 1 %.
TEST(Normals, MappedSurfacesKeepTheirEnergy) {
    for (float slope : {0.5f, 1.0f, 2.0f, 4.0f})
        for (const Material& m : {white_metal(0), white_metal(0.15f), white_metal(0.5f), white_metal(1)}) {
            double sum = 0.0, variance = 0.0;
            int count = 0;
            for (float azimuth : {0.3f, 2.0f, 4.4f})
                for (glm::vec3 eye : {glm::vec3(2, 0.3f, 0), glm::vec3(1, 2, 0)}) {
                    Scene scene;
                    add_mapped_floor(scene, m, slope, azimuth);
                    set_uniform_environment(scene, glm::vec3(1.0f));
                    const Measured full = shown(scene, eye, 128);
                    sum += full.mean, variance += full.error * full.error, ++count;
                }
            const double error = std::sqrt(variance) / count;
            EXPECT_NEAR(sum / count, 1.0, 0.004 + z_999 * error)
                << "slope " << slope << ", roughness " << m.roughness << ", metallic " << m.metallic;
            EXPECT_LT(error, 0.004);
        }
}

// The diffuse lobe loses what it has below the horizon (shared/horizon.h), and nothing else.
TEST(Normals, MappedDiffuseSurfacesLoseWhatLiesBelowTheHorizon) {
    for (float slope : {0.5f, 1.0f, 2.0f}) {
        Scene scene;
        add_mapped_floor(scene, lambertian(glm::vec3(1)), slope, 0.3f);
        set_uniform_environment(scene, glm::vec3(1.0f));
        const Measured full = shown(scene, {0.01f, 3, 0}, 512);
        const double upright = 1.0 / std::sqrt(1.0 + double(slope) * double(slope));
        EXPECT_NEAR(full.mean, 0.5 + 0.5 * upright, 0.004 + z_999 * full.error) << slope;
    }
}

TEST(Normals, SmoothShadedLowPolyMirrorsHaveNoBlackPixels) {
    Scene scene;
    add_floor(scene, white_metal(0), 0.1f);
    scene.meshes[0] = Mesh();
    add_sphere(scene.meshes[0], {0, 0, 0}, 1.0f, 12, 6);
    set_uniform_environment(scene, glm::vec3(1.0f));
    RayCaster rays(scene);
    auto request = request_for({"full"}, camera_on({1, 1.5f, 3}, {0, 0, 0}, 0.7f), 64, 4);
    const Estimate e = render_reference(rays, request);
    for (float v : e.mean.at("full").data) ASSERT_NEAR(v, 1.0f, 1e-3f);
}

// What the specular lobe reflects, the diffuse lobe does not have.
TEST(Normals, WhiteDielectricsShowAllAtEveryAngle) {
    for (float roughness : {0.0f, 0.1f, 0.4f, 1.0f})
        for (float height : {0.1f, 0.5f, 2.0f}) {
            Scene scene;
            Material m;
            m.metallic = 0.0f, m.roughness = roughness;
            add_floor(scene, m);
            set_uniform_environment(scene, glm::vec3(1.0f));
            const Measured full = shown(scene, {1, height, 0}, 128);
            EXPECT_NEAR(full.mean, 1.0, 0.006 + z_999 * full.error) << roughness << ", height " << height;

            if (roughness > 0.0f || height > 0.1f) continue;
            scene.brdf = BrdfModel::single;
            EXPECT_GT(shown(scene, {1, height, 0}, 128).mean, 1.3) << "the older model gains";
        }
}

} // namespace
} // namespace luxel
