// SPDX-License-Identifier: MIT
// Cones of any width by closed form.
#include "shared/light.h"

#include <cmath>

#include <gtest/gtest.h>

#include "shared/brdf.h"

namespace luxel::shared {
namespace {

constexpr double to_radians = 3.14159265358979323846 / 180.0;

Light spot(float inner_degrees, float outer_degrees) {
    Light l{};
    l.type = LIGHT_SPOT, l.position = {0.3f, 2.0f, -0.7f};
    l.direction = normalize(vec3(0.4f, -1.0f, 0.2f));
    l.intensity = vec3(4.0f);
    l.inner = versine(float(inner_degrees * to_radians)),
    l.outer = versine(float(outer_degrees * to_radians));
    return l;
}

// At the angle a off the axis: 4 / r^2 times ((cos a - cos outer) / (cos inner - cos outer))^2, in double.
TEST(SpotLight, ConesOfAnyWidthFallOffAsTheirCosinesDo) {
    for (double outer : {60.0, 5.0, 0.5, 0.05})
        for (double inner : {0.0, 0.6 * outer})
            for (double share : {0.0, 0.3, 0.7, 0.9, 1.1}) {
                const Light l = spot(float(inner), float(outer));
                const double angle = share * outer * to_radians, a = std::cos(angle),
                             i = std::cos(inner * to_radians), o = std::cos(outer * to_radians);
                const double t = std::min(std::max((a - o) / (i - o), 0.0), 1.0);
                const vec3 aside = normalize(cross(l.direction, vec3(0.0f, 0.0f, 1.0f)));
                const vec3 to = l.direction * float(std::cos(angle)) + aside * float(std::sin(angle));
                const LightSample s = sample_light(l, l.position + 3.0f * to);
                EXPECT_NEAR(s.irradiance.g, 4.0 / 9.0 * t * t, 2e-3 * (outer < 0.1 ? 1.0 : 0.1))
                    << outer << " " << inner << " " << share;
            }
}

TEST(SpotLight, EqualAnglesMakeAHardEdge) {
    const Light l = spot(0.5f, 0.5f);
    EXPECT_EQ(spot_falloff(l.inner, l.outer, 0.99f * l.outer), 1.0f);
    EXPECT_EQ(spot_falloff(l.inner, l.outer, 1.01f * l.outer), 0.0f);
    EXPECT_EQ(spot_falloff(0.0f, 0.0f, 0.1f), 0.0f) << "a cone without width";
}

TEST(SpotLight, VersinesKnowTheirAngles) {
    for (float angle : {0.001f, 0.1f, 1.2f}) {
        EXPECT_NEAR(versine_tangent(versine(angle)) / std::tan(angle), 1.0f, 1e-5f);
        EXPECT_NEAR(versine_angle(versine(angle)) / angle, 1.0f, 1e-5f);
    }
}

// The lobe's mean over a disc of directions around its peak, by quadrature over half vectors.
TEST(SampledLight, WidensALobeToItsMeanOverTheSource) {
    for (float alpha : {0.0004f, 0.01f, 0.04f})
        for (float radius : {0.005f, 0.03f, 0.08f}) {
            double sum = 0.0;
            const int n = 20000;
            for (int i = 0; i < n; ++i) { // by area, dense at the peak
                const double t = (i + 0.5) / n, r2 = t * t * t * t * double(radius * radius);
                const vec3 h = normalize(vec3(float(std::sqrt(r2)), 0.0f, 1.0f));
                sum += 4.0 * t * t * t * double(ggx_d(vec3(0, 0, 1), h, alpha)) / n;
            }
            const float cos_half = 0.7f, solid_angle = 4.0f * cos_half * PI * radius * radius;
            const float wide = widened_alpha(alpha, solid_angle, cos_half);
            EXPECT_NEAR(1.0 / double(PI * wide * wide) / sum, 1.0, alpha < 0.001f ? 0.05 : 0.02)
                << alpha << " " << radius;
        }
    EXPECT_EQ(widened_alpha(0.2f, 0.0f, 0.5f), 0.2f);
    EXPECT_EQ(widened_alpha(0.2f, 100.0f, 0.5f), 1.0f);
}

TEST(SampledLight, KnowsItsSolidAngle) {
    Light l{};
    l.type = LIGHT_COSINE, l.position = {0, 2, 0}, l.direction = {0, -1, 0}, l.extent = 0.5f;
    EXPECT_NEAR(sampled_solid_angle(l, sample_light(l, {0, 0, 0})), 0.125f, 1e-6f);
    EXPECT_NEAR(sampled_solid_angle(l, sample_light(l, {2, 0, 0})), 0.5f * std::sqrt(0.5f) / 8.0f, 1e-6f);
    EXPECT_EQ(sampled_solid_angle(l, sample_light(l, {0, 3, 0})), 0.0f);
    l.type = LIGHT_DIRECTIONAL;
    EXPECT_EQ(sampled_solid_angle(l, sample_light(l, {0, 0, 0})), 0.5f);
}

} // namespace
} // namespace luxel::shared
