// SPDX-License-Identifier: MIT
// Sample lights against closed forms: the rectangle's form factor, the environment's irradiance, SH of
// polynomials.
#include "scene/lights.h"

#include <cmath>

#include <gtest/gtest.h>

#include "scene/environment.h"
#include "scene/procedural.h"
#include "shared/random.h"
#include "shared/sampling.h"

namespace luxel {
namespace {

using shared::Light;

constexpr double pi = 3.14159265358979;

double irradiance(const std::vector<Light>& lights, glm::vec3 position, glm::vec3 normal) {
    double sum = 0;
    for (const Light& light : lights) {
        const shared::LightSample s = shared::sample_light(light, position);
        sum += double(s.irradiance.g * std::max(0.0f, glm::dot(s.wi, normal)));
    }
    return sum;
}

// Lambert's formula for a polygon entirely above the receiver's horizon: E = L/2 sum of angle x (edge normal
// . n).
double polygon_irradiance(const std::vector<glm::dvec3>& corners, glm::dvec3 position, glm::dvec3 normal) {
    double sum = 0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const glm::dvec3 a = glm::normalize(corners[i] - position);
        const glm::dvec3 b = glm::normalize(corners[(i + 1) % corners.size()] - position);
        sum += std::acos(glm::dot(a, b)) * glm::dot(glm::normalize(glm::cross(a, b)), normal);
    }
    return std::abs(sum) / 2;
}

// Least-squares slope of log error over log count.
double slope(const std::vector<double>& counts, const std::vector<double>& errors) {
    double sx = 0, sy = 0, sxx = 0, sxy = 0;
    for (std::size_t i = 0; i < counts.size(); ++i) {
        const double x = std::log(counts[i]), y = std::log(errors[i]);
        sx += x, sy += y, sxx += x * x, sxy += x * y;
    }
    const auto n = double(counts.size());
    return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

TEST(Lights, FindsCornellsEmitter) {
    const Scene scene = cornell();
    const std::vector<EmissiveTriangle> found = emissive_triangles(scene);
    ASSERT_EQ(found.size(), 2u);
    for (const EmissiveTriangle& e : found) {
        EXPECT_LT(glm::length(e.normal - glm::vec3(0, -1, 0)), 1e-6f);
        EXPECT_NEAR(e.area, 0.47f * 0.38f / 2.0f, 1e-6f);
        EXPECT_EQ(e.emission, glm::vec3(17, 12, 4));
        EXPECT_FALSE(e.two_sided);
        EXPECT_EQ(scene.instances[std::size_t(e.instance)].name, "light");
    }
}

TEST(Lights, MirroringTransformKeepsTheFront) {
    Scene scene = cornell();
    for (Instance& instance : scene.instances)
        instance.transform = glm::mat4(glm::mat3(-2, 0, 0, 0, 2, 0, 0, 0, 2));
    for (const EmissiveTriangle& e : emissive_triangles(scene)) {
        EXPECT_LT(glm::length(e.normal - glm::vec3(0, -1, 0)), 1e-6f);
        EXPECT_NEAR(e.area, 0.47f * 0.38f * 2.0f, 1e-5f);
    }
}

// Left half of the texture black, right half white, over a quad: the two triangles hold 1/4 and 3/4 of it.
TEST(Lights, EmissionTextureIsAveragedOverTheTriangle) {
    Scene scene;
    Texture texture;
    texture.pixels = {64, 64, std::vector<std::uint8_t>(64 * 64 * 4, 0)};
    texture.nearest = true;
    for (int y = 0; y < 64; ++y)
        for (int x = 32; x < 64; ++x)
            for (int c = 0; c < 4; ++c) texture.pixels.rgba[std::size_t((y * 64 + x) * 4 + c)] = 255;
    scene.textures = {texture};
    Material material;
    material.emission = glm::vec3(8.0f);
    material.emission_texture.texture = 0;
    scene.materials = {material};
    scene.meshes.emplace_back();
    scene.instances.emplace_back();
    add_quad(scene.meshes[0], {0, 0, 0}, {1, 0, 0}, {0, 1, 0});

    const std::vector<EmissiveTriangle> found = emissive_triangles(scene);
    ASSERT_EQ(found.size(), 2u);
    EXPECT_NEAR(found[0].emission.r, 6.0f, 0.1f);
    EXPECT_NEAR(found[1].emission.r, 2.0f, 0.1f);
}

TEST(Lights, SamplesCarryThePowerExactly) {
    Scene scene = cornell();
    for (const bool two_sided : {false, true}) {
        scene.materials.back().double_sided = two_sided;
        for (const int count : {1, 2, 7, 64, 1000}) {
            const std::vector<Light> lights = emitter_sample_lights(scene, count, 5);
            ASSERT_EQ(int(lights.size()), count);
            glm::vec3 sum(0.0f);
            for (const Light& light : lights) sum += light.intensity;
            const glm::vec3 power = glm::vec3(17, 12, 4) * (0.47f * 0.38f * (two_sided ? 2.0f : 1.0f));
            EXPECT_LT(glm::length(sum - power), 1e-4f * glm::length(power));
        }
    }
    EXPECT_TRUE(emitter_sample_lights(shapes(ShapesLight::point), 16, 1).empty());
}

TEST(Lights, DeterministicForASeed) {
    const std::vector<Light> a = emitter_sample_lights(cornell(), 32, 1),
                             b = emitter_sample_lights(cornell(), 32, 1),
                             c = emitter_sample_lights(cornell(), 32, 2);
    int differing = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        EXPECT_EQ(a[i].position, b[i].position);
        differing += a[i].position != c[i].position;
    }
    EXPECT_GT(differing, 16);
}

TEST(Lights, CornellsSampleLightsConvergeToTheRectangle) {
    const Scene scene = cornell();
    const std::vector<glm::dvec3> corners = {
        {-0.24, 1.98, -0.22}, {0.23, 1.98, -0.22}, {0.23, 1.98, 0.16}, {-0.24, 1.98, 0.16}};

    // Mean relative error over points of the floor and seeds.
    std::vector<double> counts, errors;
    for (const int count : {4, 16, 64, 256, 1024}) {
        double sum = 0;
        int points = 0;
        for (std::uint32_t seed = 0; seed < 8; ++seed) {
            const std::vector<Light> lights = emitter_sample_lights(scene, count, seed);
            for (const float x : {-0.9f, -0.3f, 0.0f, 0.5f})
                for (const float z : {-0.8f, 0.1f, 0.7f}) {
                    const double truth = 12.0 * polygon_irradiance(corners, {x, 0, z}, {0, 1, 0});
                    sum += std::abs(irradiance(lights, {x, 0, z}, {0, 1, 0}) / truth - 1.0), ++points;
                }
        }
        counts.push_back(count), errors.push_back(sum / points);
    }

    // The lights hang 1e-4 of the radius below the lamp: (1 + 2 x 1.7e-4 / 1.98) bounds what remains.
    EXPECT_LT(errors.back(), 1e-3);
    EXPECT_LT(slope({counts.begin(), counts.end() - 1}, {errors.begin(), errors.end() - 1}), -0.5);
}

// Radiance 1 + y/2 + x/4 plus a lamp: sums over texels are the analytic integral of a piecewise-constant map.
Environment lamp_environment() {
    Environment environment;
    environment.radiance = Image(64, 32, 3);
    environment.rotation = 0.4f;
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 64; ++x)
            environment.radiance.set_rgb(
                x, y, glm::vec3(1.0f + 0.03f * float(31 - y), 1.0f, 0.5f + 0.01f * float(x)));
    environment.radiance.set_rgb(20, 9, glm::vec3(300.0f));
    return environment;
}

double environment_irradiance(const Environment& environment, glm::vec3 normal) {
    double sum = 0;
    constexpr int parts = 4;
    const Image& map = environment.radiance;
    for (int y = 0; y < map.height * parts; ++y) {
        const double weight = double(texel_solid_angle(environment, y / parts)) / (parts * parts);
        const float top = std::cos(shared::PI * float(y / parts) / float(map.height)),
                    bottom = std::cos(shared::PI * float(y / parts + 1) / float(map.height));
        const float v =
            std::acos(glm::mix(top, bottom, (float(y % parts) + 0.5f) / float(parts))) / shared::PI;
        for (int x = 0; x < map.width * parts; ++x) {
            const glm::vec3 d =
                environment_direction(environment, {(float(x) + 0.5f) / float(map.width * parts), v});
            sum += double(map.rgb(x / parts, y / parts).g * std::max(0.0f, glm::dot(d, normal))) * weight;
        }
    }
    return sum * double(environment.scale);
}

TEST(Lights, EnvironmentLightsConvergeToTheIrradiance) {
    const Environment environment = lamp_environment();
    constexpr int planes = 12;
    std::vector<glm::vec3> normals;
    std::vector<double> truth;
    for (std::uint32_t i = 0; i < planes; ++i) {
        normals.push_back(shared::sample_sphere(shared::hammersley(i, planes)));
        truth.push_back(environment_irradiance(environment, normals.back()));
    }

    std::vector<double> counts, errors;
    for (const int count : {16, 64, 256, 1024, 4096}) {
        double sum = 0;
        for (std::uint32_t seed = 0; seed < 8; ++seed) {
            const std::vector<Light> lights = environment_sample_lights(environment, count, seed);
            ASSERT_EQ(int(lights.size()), count);
            for (int i = 0; i < planes; ++i)
                sum += std::abs(
                    irradiance(lights, {0, 0, 0}, normals[std::size_t(i)]) / truth[std::size_t(i)] - 1.0);
        }
        counts.push_back(count), errors.push_back(sum / (8 * planes));
    }
    // Plain random sampling has slope -1/2; stratification must do better.
    EXPECT_LT(slope(counts, errors), -0.6);
    EXPECT_LT(errors.back(), 3e-3);
}

TEST(Lights, EnvironmentBecomesLights) {
    Scene scene = shapes(ShapesLight::directional);
    scene.environment = lamp_environment();
    const Scene lit = with_environment_as_lights(scene, 10, 3);
    EXPECT_TRUE(lit.environment.empty());
    ASSERT_EQ(lit.lights.size(), 11u);
    for (std::size_t i = 1; i < 11; ++i) {
        EXPECT_EQ(lit.lights[i].type, shared::LIGHT_DIRECTIONAL);
        EXPECT_NEAR(glm::length(lit.lights[i].direction), 1.0f, 1e-5f);
    }
}

// A map of f(direction) at texel centers.
template <class F> Environment map_of(F&& f) {
    Environment environment;
    environment.radiance = Image(512, 256, 3);
    for (int y = 0; y < 256; ++y)
        for (int x = 0; x < 512; ++x) {
            const glm::vec3 d =
                environment_direction(environment, {(float(x) + 0.5f) / 512, (float(y) + 0.5f) / 256});
            environment.radiance.set_rgb(x, y, glm::vec3(f(d), 2.0f * f(d), 0.0f));
        }
    return environment;
}

void expect_coefficients(const Environment& environment, const std::vector<double>& expected) {
    const std::vector<glm::vec3> sh = project_environment_sh(environment);
    ASSERT_EQ(sh.size(), 9u);
    for (std::size_t i = 0; i < 9; ++i) {
        // Midpoint rule on 256 rows: relative error of (pi/256)^2 / 24 = 6e-6 at most per degree, and float
        // sums.
        EXPECT_NEAR(sh[i].r, expected[i], 2e-4) << "coefficient " << i;
        EXPECT_NEAR(sh[i].g, 2.0 * expected[i], 4e-4) << "coefficient " << i;
        EXPECT_NEAR(sh[i].b, 0.0, 1e-6);
    }
}

// The integral of a polynomial times its own normalized harmonic is known: Y = c p gives a coefficient 1 / c.
TEST(Lights, ShOfConstantLinearAndQuadratic) {
    const double y0 = std::sqrt(4 * pi), y1 = std::sqrt(4 * pi / 3);
    expect_coefficients(map_of([](glm::vec3) { return 1.0f; }), {y0, 0, 0, 0, 0, 0, 0, 0, 0});
    expect_coefficients(map_of([](glm::vec3 d) { return 1 + d.y + 0.5f * d.z + 0.25f * d.x; }),
                        {y0, y1, 0.5 * y1, 0.25 * y1, 0, 0, 0, 0, 0});
    const double xy = std::sqrt(4 * pi / 15), z2 = std::sqrt(16 * pi / 5), x2y2 = std::sqrt(16 * pi / 15);
    expect_coefficients(map_of([](glm::vec3 d) {
                            return 2 + d.x * d.y + 2 * d.y * d.z + (3 * d.z * d.z - 1) + 3 * d.x * d.z +
                                   (d.x * d.x - d.y * d.y);
                        }),
                        {2 * y0, 0, 0, 0, xy, 2 * xy, z2, 3 * xy, x2y2});
}

TEST(Lights, ShFollowsRotationAndScale) {
    Environment environment = map_of([](glm::vec3 d) { return 1 + d.x; });
    environment.rotation = shared::PI / 2; // +x goes to -z
    environment.scale = 3.0f;
    const double y0 = std::sqrt(4 * pi), y1 = std::sqrt(4 * pi / 3);
    const std::vector<glm::vec3> sh = project_environment_sh(environment);
    EXPECT_NEAR(sh[0].r, 3 * y0, 1e-3);
    EXPECT_NEAR(sh[2].r, -3 * y1, 1e-3);
    EXPECT_NEAR(sh[3].r, 0.0, 1e-3);
    EXPECT_EQ(project_environment_sh(Environment{})[0], glm::vec3(0.0f));
}

TEST(Lights, GradientSkyRunsFromHorizonToZenith) {
    const Environment sky = gradient_sky({1, 0, 0}, {0, 0, 1}, {0, 1, 0});
    EXPECT_GT(evaluate(sky, {0, 1, 0}).b, 0.95f);
    EXPECT_GT(evaluate(sky, {1, 0.001f, 0}).r, 0.95f);
    EXPECT_EQ(evaluate(sky, {0, -0.2f, 1}), glm::vec3(0, 1, 0));
}

} // namespace
} // namespace luxel
