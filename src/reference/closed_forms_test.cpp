// SPDX-License-Identifier: MIT
// The path tracer against answers known on paper.
#include <gtest/gtest.h>

#include "reference/reference.h"
#include "reference/test_scenes.h"
#include "shared/brdf.h"
#include "shared/sampling.h"

namespace luxel {
namespace {

using namespace testing;
using shared::PI;

Estimate render(const Scene& scene, const ReferenceRequest& request) {
    RayCaster rays(scene);
    return render_reference(rays, request);
}

// Within the run's own 99.9 % interval, and the interval itself is narrow.
void expect_equal(const Measured& m, double expected, double tolerance) {
    EXPECT_NEAR(m.mean, expected, z_999 * m.error + 2e-6 * std::abs(expected));
    EXPECT_NEAR(m.mean, expected, tolerance * expected);
}

// Every face emits 1 and reflects albedo: 1 + a + a^2 + ... = 1 / (1 - a) everywhere.
class Furnace : public ::testing::TestWithParam<float> {};
TEST_P(Furnace, HoldsTheGeometricSeries) {
    Scene scene = furnace(GetParam());
    auto request = request_for({"full", "direct", "diffuse1"},
                               camera_on({0.1f, 0.2f, 0.3f}, {0.6f, -0.5f, -1}, 1.2f), 24, 384);
    Estimate e = render(scene, request);
    const double a = double(GetParam());
    expect_equal(measure(e, "full"), 1.0 / (1.0 - a), 0.0025);
    expect_equal(measure(e, "direct"), 1.0 + a, 0.0025);
    if (a > 0.0) expect_equal(measure(e, "diffuse1"), a * a, 0.0025);
}
INSTANTIATE_TEST_SUITE_P(Albedos, Furnace, ::testing::Values(0.0f, 0.2f, 0.5f, 0.8f, 0.9f));

shared::Light light_of(shared::uint type, glm::vec3 position, glm::vec3 direction) {
    shared::Light l{};
    l.type = type;
    l.position = position;
    l.direction = glm::normalize(direction);
    l.intensity = glm::vec3(5, 3, 1);
    l.inner = shared::versine(0.3f);
    l.outer = shared::versine(0.6f);
    return l;
}

// Reflected radiance of a Lambertian floor at x under one light, by the light's definition.
double floor_radiance(const shared::Light& l, glm::vec3 x, double albedo) {
    if (l.type == shared::LIGHT_DIRECTIONAL) return albedo / double(PI) * 5.0 * double(-l.direction.y);
    glm::dvec3 d = glm::dvec3(l.position - x);
    double r = glm::length(d), cos_floor = d.y / r, on_axis = -glm::dot(glm::dvec3(l.direction), d) / r;
    double intensity = 5.0;
    if (l.type == shared::LIGHT_SPOT) {
        double t = (on_axis - std::cos(0.6)) / (std::cos(0.3) - std::cos(0.6));
        t = std::clamp(t, 0.0, 1.0);
        intensity *= t * t;
    }
    if (l.type == shared::LIGHT_COSINE) intensity *= std::max(on_axis, 0.0);
    return albedo / double(PI) * intensity * cos_floor / (r * r);
}

TEST(ClosedForms, PunctualLightsOverAFloor) {
    for (shared::uint type :
         {shared::LIGHT_POINT, shared::LIGHT_SPOT, shared::LIGHT_DIRECTIONAL, shared::LIGHT_COSINE}) {
        Scene scene;
        add_floor(scene, lambertian(glm::vec3(0.6f)));
        scene.lights = {light_of(type, {0.3f, 2.0f, -0.4f}, {0.2f, -1, 0.1f})};
        for (float x : {-1.0f, 0.0f, 0.5f, 1.2f}) {
            auto request = request_for({"full", "direct"}, camera_on({0, 3, 1}, {x, 0, 0.2f}), 1, 1);
            request.settings.pixel_center = true;
            Estimate e = render(scene, request);
            double expected = floor_radiance(scene.lights[0], {x, 0, 0.2f}, 0.6);
            double tolerance = 1e-4 * std::max(expected, 0.01);
            EXPECT_NEAR(measure(e, "direct").mean, expected, tolerance) << "type " << type << ", x " << x;
            EXPECT_NEAR(measure(e, "full").mean, expected, tolerance) << "type " << type << ", x " << x;
        }
    }
}

// More lights than are summed one by one: the drawn subset has the mean of the whole.
TEST(ClosedForms, ManyLightsAreDrawnWithoutBias) {
    Scene scene;
    add_floor(scene, lambertian(glm::vec3(0.6f)));
    double expected = 0.0;
    for (int i = 0; i < 12; ++i) {
        scene.lights.push_back(light_of(shared::LIGHT_POINT,
                                        {float(i % 4) - 1.5f, 0.5f + 0.2f * float(i), float(i / 4) - 1.0f},
                                        {0, -1, 0}));
        expected += floor_radiance(scene.lights.back(), {0, 0, 0}, 0.6);
    }
    // One of them is behind a screen, which the draw does not know.
    add_object(scene, lambertian(glm::vec3(0)), {-0.6f, 0.55f, 0.1f}, {0.2f, 0, 0}, {0, 0, -0.2f});
    Estimate e = render(scene, request_for({"direct"}, camera_on({0, 3, 1}, {0, 0, 0}), 8, 512));
    expect_equal(measure(e, "direct"), expected, 0.01);
}

// Irradiance from a uniform polygon: a sum over its edges [Lambert1760].
double polygon_irradiance(const std::vector<glm::dvec3>& corners, glm::dvec3 x, glm::dvec3 n) {
    double sum = 0.0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        glm::dvec3 a = glm::normalize(corners[i] - x),
                   b = glm::normalize(corners[(i + 1) % corners.size()] - x);
        sum += std::acos(glm::dot(a, b)) * glm::dot(glm::normalize(glm::cross(a, b)), n);
    }
    return std::abs(sum) / 2.0;
}

TEST(ClosedForms, RectangleLightOverAFloor) {
    Scene scene;
    add_floor(scene, lambertian(glm::vec3(0.5f)));
    add_object(scene, lambertian(glm::vec3(0.0f), glm::vec3(4.0f)), {-0.5f, 1, -0.5f}, {1, 0, 0},
               {0, 0, 1}); // faces down
    std::vector<glm::dvec3> corners = {{-.5, 1, -.5}, {.5, 1, -.5}, {.5, 1, .5}, {-.5, 1, .5}};
    for (glm::vec3 x : {glm::vec3(0, 0, 0), glm::vec3(1.2f, 0, -0.7f)}) {
        Estimate e = render(scene, request_for({"direct"}, camera_on({3, 0.8f, 0.1f}, x), 16, 512));
        double expected = 0.5 / double(PI) * 4.0 * polygon_irradiance(corners, glm::dvec3(x), {0, 1, 0});
        expect_equal(measure(e, "direct"), expected, 0.005);
    }
    // From above it is black: one-sided.
    Estimate above = render(scene, request_for({"direct"}, camera_on({0, 3, 0}, {0, 1, 0}), 2, 4));
    EXPECT_EQ(measure(above, "direct").mean, 0.0);
}

TEST(ClosedForms, UniformEnvironment) {
    Scene scene;
    add_floor(scene, lambertian(glm::vec3(0.7f)));
    set_uniform_environment(scene, glm::vec3(2.0f));
    Estimate e = render(scene, request_for({"full"}, camera_on({0, 3, 1}, {0, 0, 0}), 8, 256));
    expect_equal(measure(e, "full"), 1.4, 0.005);

    // Past the floor there is only the environment.
    Estimate sky =
        render(scene, request_for({"full", "direct", "specular"}, camera_on({0, 3, 1}, {0, 9, 0}), 2, 1));
    EXPECT_EQ(measure(sky, "full").mean, 2.0);
    EXPECT_EQ(measure(sky, "direct").mean, 2.0);
    EXPECT_EQ(measure(sky, "specular").mean, 0.0);
    EXPECT_EQ(sky.mask.data[0], 0.0f);
}

// A metal under uniform light shows its directional albedo, here by quadrature over the same lobe.
TEST(ClosedForms, RoughMetalShowsItsDirectionalAlbedo) {
    for (float roughness : {0.1f, 0.35f, 0.8f}) {
        Scene scene;
        Material metal;
        metal.base_color = glm::vec4(0.9f, 0.6f, 0.3f, 1.0f);
        metal.roughness = roughness;
        add_floor(scene, metal);
        set_uniform_environment(scene, glm::vec3(1.0f));
        glm::vec3 eye(2, 1.2f, 0), n(0, 0, 1);
        Estimate e = render(scene, request_for({"direct"}, camera_on(eye, {0, 0, 0}), 16, 256));

        float cos_o = glm::normalize(eye).y;
        shared::Brdf b = shared::make_brdf_toward(cos_o, glm::vec3(0.9f, 0.6f, 0.3f), 1.0f, roughness, 1.5f,
                                                  1.0f, glm::vec3(1));
        glm::vec3 wo(std::sqrt(1.0f - cos_o * cos_o), 0.0f, cos_o);
        double expected = 0.0;
        const shared::uint count = 1u << 16;
        for (shared::uint i = 0; i < count; ++i) {
            glm::vec3 wi =
                glm::reflect(-wo, shared::sample_visible_normal(wo, b.alpha, shared::hammersley(i, count)));
            if (wi.z <= 0.0f) continue;
            float pdf = shared::ggx_reflection_pdf(shared::ggx_d(n, glm::normalize(wi + wo), b.alpha), cos_o,
                                                   b.alpha);
            expected += double(shared::evaluate_specular(b, n, wo, wi).r * wi.z / pdf) / count;
        }
        expect_equal(measure(e, "direct"), expected, 0.005);
    }
}

TEST(ClosedForms, MirrorReflectsByFresnel) {
    Scene scene;
    Material mirror;
    mirror.base_color = glm::vec4(0.9f, 0.6f, 0.3f, 1.0f);
    mirror.roughness = 0.0f;
    add_floor(scene, mirror);
    set_uniform_environment(scene, glm::vec3(1.0f));
    glm::vec3 eye(2, 1, 0);
    Estimate e = render(scene, request_for({"direct", "specular", "full"}, camera_on(eye, {0, 0, 0}), 2, 4));
    float expected = shared::fresnel_schlick(glm::vec3(0.9f), glm::vec3(1), glm::normalize(eye).y).r;
    EXPECT_NEAR(measure(e, "specular").mean, expected, 1e-5);
    EXPECT_NEAR(measure(e, "full").mean, expected, 1e-5);
    EXPECT_EQ(measure(e, "direct").mean, 0.0) << "a mirror shows nothing by direct light";
}

// Clear glass neither makes nor loses light: in uniform surroundings it cannot be seen.
TEST(ClosedForms, ClearGlassIsInvisibleInUniformLight) {
    for (bool thin : {true, false}) {
        Scene scene;
        Material glass;
        glass.metallic = glass.roughness = 0.0f;
        glass.transmission = 1.0f;
        glass.thin = thin;
        add_floor(scene, glass, 0.1f);
        scene.meshes[0] = Mesh();
        if (thin)
            add_quad(scene.meshes[0], {-1, -1, 0}, {2, 0, 0}, {0, 2, 0});
        else
            add_sphere(scene.meshes[0], {0, 0, 0}, 1.0f, 64, 32);
        set_uniform_environment(scene, glm::vec3(1.0f));
        Estimate e = render(scene, request_for({"specular", "direct", "diffuse"},
                                               camera_on({0, 0, 4}, {0.4f, 0.3f, 0}, 0.05f), 8, 256));
        Measured m = measure(e, "specular");
        EXPECT_NEAR(m.mean, 1.0, z_999 * m.error + 1e-4) << "thin " << thin;
        EXPECT_EQ(measure(e, "direct").mean, 0.0);
        EXPECT_EQ(measure(e, "diffuse").mean, 0.0);
    }
}

// Half transmission over a diffuse base: the base keeps half of its reflectance.
TEST(ClosedForms, PartialTransmissionSharesTheSurface) {
    Scene scene;
    Material m = lambertian(glm::vec3(0.8f));
    m.transmission = 0.5f;
    m.roughness = 0.0f;
    m.ior = 1.0f; // the sheet itself reflects nothing
    add_floor(scene, m);
    set_uniform_environment(scene, glm::vec3(1.0f));
    Estimate e = render(scene, request_for({"full", "direct"}, camera_on({0, 2, 1}, {0, 0, 0}), 8, 512));
    expect_equal(measure(e, "direct"), 0.4, 0.01);
    expect_equal(measure(e, "full"), 0.8, 0.01); // .4 reflected, .4 let through, both tinted
}

// A ceiling at height h < R hides the cosine-weighted cone with cos > h / R.
TEST(ClosedForms, AmbientOcclusionUnderACeiling) {
    Scene scene;
    add_floor(scene, lambertian(glm::vec3(0.5f)));
    add_object(scene, lambertian(glm::vec3(0.5f)), {-50, 0.4f, -50}, {100, 0, 0}, {0, 0, 100});
    const double q = 0.4;
    // tangent: the sphere's volume below the ceiling; exponential: 1 - 2 E_3(q), by the recurrence from E_1.
    const double e1 = -std::expint(-q);
    const double expected[] = {q * q, q * q + 4.0 / 3.0 * std::sqrt(q) * (1.0 - std::pow(q, 1.5)),
                               q * q + 2.0 * q * q * (1.0 - q), 3.0 * q * q - 2.0 * q * q * q,
                               1.0 - (std::exp(-q) * (1.0 - q) + q * q * e1)};
    for (Membership membership : {Membership::step, Membership::sqrt, Membership::cubic, Membership::tangent,
                                  Membership::exponential}) {
        auto request = request_for({"ao"}, camera_on({2, 0.2f, 0}, {0, 0, 0}), 16, 256);
        request.settings.ao_radius = 1.0f;
        request.settings.ao_membership = membership;
        expect_equal(measure(render(scene, request), "ao"), expected[int(membership)], 0.02);
    }
}

} // namespace
} // namespace luxel
