// SPDX-License-Identifier: MIT
// The environment as directional lights and as spherical harmonics.
#include "core/error.h"
#include "scene/environment.h"
#include "scene/lights.h"
#include "shared/random.h"
#include "shared/sampling.h"

namespace luxel {

std::vector<shared::Light> environment_sample_lights(const Environment& environment, int count,
                                                     std::uint32_t seed) {
    LUXEL_ASSERT(count > 0, "count={}", count);
    const EnvironmentSampler sampler(environment);
    std::vector<shared::Light> lights;
    if (sampler.empty()) return lights;

    // A low-discrepancy set in the space of the two-dimensional CDF; every light has the same luminance.
    const glm::vec2 shift(shared::uniform_float(shared::hash2(seed, 0x656e7630u)),
                          shared::uniform_float(shared::hash2(seed, 0x656e7631u)));
    for (int i = 0; i < count; ++i) {
        const EnvironmentSample s =
            sampler.sample(glm::fract(shared::hammersley(std::uint32_t(i), std::uint32_t(count)) + shift));
        shared::Light light{};
        light.type = shared::LIGHT_DIRECTIONAL;
        light.direction = -s.direction;
        light.extent = 1.0f / (s.pdf * float(count));
        light.intensity = s.radiance * light.extent;
        lights.push_back(light);
    }
    return lights;
}

Scene with_environment_as_lights(Scene scene, int count, std::uint32_t seed) {
    // As lights of the scene they are as sharp as any other.
    for (shared::Light light : environment_sample_lights(scene.environment, count, seed))
        light.extent = 0.0f, scene.lights.push_back(light);
    scene.environment = {};
    return scene;
}

std::vector<glm::vec3> project_environment_sh(const Environment& environment) {
    std::vector<glm::dvec3> sums(9, glm::dvec3(0.0));
    if (environment.empty()) return {sums.begin(), sums.end()};

    // Midpoint rule per texel, weighted by the exact solid angle [Ramamoorthi2001, eq. 3 and 10].
    const Image& map = environment.radiance;
    for (int y = 0; y < map.height; ++y) {
        const double solid_angle = double(texel_solid_angle(environment, y));
        for (int x = 0; x < map.width; ++x) {
            const glm::dvec3 d = environment_direction(
                environment, {(float(x) + 0.5f) / float(map.width), (float(y) + 0.5f) / float(map.height)});
            const glm::dvec3 light = glm::dvec3(map.rgb(x, y)) * solid_angle;
            const double basis[9] = {0.282094791773878,
                                     0.488602511902920 * d.y,
                                     0.488602511902920 * d.z,
                                     0.488602511902920 * d.x,
                                     1.092548430592079 * d.x * d.y,
                                     1.092548430592079 * d.y * d.z,
                                     0.315391565252520 * (3.0 * d.z * d.z - 1.0),
                                     1.092548430592079 * d.x * d.z,
                                     0.546274215296040 * (d.x * d.x - d.y * d.y)};
            for (int i = 0; i < 9; ++i) sums[std::size_t(i)] += light * basis[i];
        }
    }
    std::vector<glm::vec3> coefficients;
    for (const glm::dvec3& sum : sums) coefficients.emplace_back(sum * double(environment.scale));
    return coefficients;
}

Environment gradient_sky(glm::vec3 horizon, glm::vec3 zenith, glm::vec3 ground) {
    constexpr int width = 128, height = 64;
    Environment sky;
    sky.radiance = Image(width, height, 3);
    for (int y = 0; y < height; ++y) {
        const float elevation = 1.0f - (float(y) + 0.5f) / (height / 2); // 1 at the zenith, 0 at the horizon
        const glm::vec3 color = elevation < 0.0f ? ground : glm::mix(horizon, zenith, elevation);
        for (int x = 0; x < width; ++x) sky.radiance.set_rgb(x, y, color);
    }
    return sky;
}

} // namespace luxel
