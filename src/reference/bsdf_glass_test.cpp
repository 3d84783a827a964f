// SPDX-License-Identifier: MIT
// Rough glass: reciprocity, density, energy.
#include "reference/bsdf_glass.h"

#include <gtest/gtest.h>

#include "reference/test_scenes.h"
#include "shared/sampling.h"

namespace luxel {
namespace {

using namespace testing;
using shared::PI;

Material rough_glass(float roughness, bool thin, float ior = 1.5f) {
    Material m = solid_glass(ior);
    m.roughness = roughness;
    m.thin = thin;
    return m;
}

// A plane of that glass whose front faces +z, met by a ray that comes from `wo`.
Surface plane_of(const Material& m, glm::vec3 wo) {
    Surface s{};
    s.material = &m;
    s.normal = s.geometric_normal = glm::vec3(0, 0, 1);
    s.front = wo.z > 0.0f;
    s.roughness = m.roughness, s.transmission = 1.0f;
    s.specular = 1.0f, s.specular_color = s.base_color = glm::vec3(1.0f);
    s.brdf.alpha = std::max(m.roughness * m.roughness, shared::MIN_ALPHA);
    s.glass_gain = 1.0f;
    return s;
}

// BSDF times cosine, and density, of light from wi toward wo.
GlassValue glass_value(const Material& m, glm::vec3 wo, glm::vec3 wi) {
    const Surface s = plane_of(m, wo);
    return evaluate_rough_glass(ShadingPoint(s, -wo), wi);
}

glm::vec3 on_sphere(shared::uint i, shared::uint count) {
    return shared::sample_sphere(shared::hammersley(i, count));
}

// f(wi -> wo) / n_o^2 = f(wo -> wi) / n_i^2 [Veach1997, eq. 5.14].
TEST(RoughGlass, IsReciprocal) {
    for (bool thin : {true, false})
        for (float roughness : {0.2f, 0.6f, 1.0f}) {
            const Material m = rough_glass(roughness, thin);
            int compared = 0;
            for (shared::uint i = 0; i < 200; ++i) {
                const glm::vec3 wo = on_sphere(i, 200), wi = on_sphere((i * 77u + 13u) % 200u, 200);
                if (std::abs(wo.z) < 0.05f || std::abs(wi.z) < 0.05f) continue;
                const double forth = double(glass_value(m, wo, wi).value.x) / std::abs(double(wi.z)),
                             back = double(glass_value(m, wi, wo).value.x) / std::abs(double(wo.z));
                const double index_o = thin || wo.z > 0.0f ? 1.0 : 1.5,
                             index_i = thin || wi.z > 0.0f ? 1.0 : 1.5;
                EXPECT_NEAR(forth / (index_o * index_o), back / (index_i * index_i),
                            1e-3 * std::max(forth, 0.01));
                compared += forth > 0.0;
            }
            EXPECT_GT(compared, 60);
        }
}

// Sampling by its own density and uniform sampling find the same light.
TEST(RoughGlass, DensityIsThatOfItsSamples) {
    for (bool thin : {true, false})
        for (glm::vec3 wo :
             {glm::normalize(glm::vec3(0.6f, 0.1f, 0.7f)), glm::normalize(glm::vec3(0.3f, 0, -1))}) {
            const Material m = rough_glass(0.5f, thin);
            const Surface s = plane_of(m, wo);
            const ShadingPoint p(s, -wo);
            const shared::uint count = 1u << 16;
            double uniform = 0.0, own = 0.0, density = 0.0, drawn = 0.0;
            for (shared::uint i = 0; i < count; ++i) {
                const glm::vec2 u = shared::hammersley(i, count);
                const glm::vec3 w = shared::sample_sphere(u);
                const GlassValue at = evaluate_rough_glass(p, w);
                // A light that is brighter to one side, so that the shape of the lobe counts.
                uniform += double(at.value.x * (1.5f + w.x)) * 4.0 * double(PI) / count;
                density += double(at.pdf) * 4.0 * double(PI) / count;
                const glm::vec3 wi = sample_rough_glass(p, u, shared::uniform_float(shared::hash2(i, 7u)));
                if (wi == glm::vec3(0.0f)) continue;
                const GlassValue of = evaluate_rough_glass(p, wi);
                ASSERT_GT(of.pdf, 0.0f);
                own += double(of.value.x / of.pdf * (1.5f + wi.x)) / count;
                drawn += 1.0 / count;
            }
            EXPECT_NEAR(own, uniform, 0.01 * uniform);
            EXPECT_NEAR(drawn, density, 0.01) << "what is not drawn is what the density lacks";
        }
}

Measured through(const Material& m, int spp) {
    Scene scene;
    add_floor(scene, m, 0.1f);
    scene.meshes[0] = Mesh();
    if (m.thin)
        add_quad(scene.meshes[0], {-1, -1, 0}, {2, 0, 0}, {0, 2, 0});
    else
        add_sphere(scene.meshes[0], {0, 0, 0}, 1.0f, 64, 32);
    set_uniform_environment(scene, glm::vec3(1.0f));
    RayCaster rays(scene);
    return measure(
        render_reference(rays, request_for({"full"}, camera_on({0, 0, 4}, {0.4f, 0.3f, 0}, 0.05f), 8, spp)),
        "full");
}

TEST(RoughGlass, SheetsKeepTheirEnergyAndSolidsMakeNone) {
    for (float roughness : {0.05f, 0.2f, 0.5f, 1.0f}) {
        const Measured sheet = through(rough_glass(roughness, true), 128);
        EXPECT_NEAR(sheet.mean, 1.0, 0.005 + z_999 * sheet.error) << roughness;
        // Refracting facets scatter once: what they pass on to each other is lost.
        const Measured solid = through(rough_glass(roughness, false), 128);
        EXPECT_LE(solid.mean, 1.0 + z_999 * solid.error) << roughness;
        EXPECT_GE(solid.mean, roughness < 0.3f ? 0.98 : roughness < 0.7f ? 0.6 : 0.3) << roughness;
    }
}

// A lamp behind a frosted pane lights it all over; behind a clear one it is seen as it is.
TEST(RoughGlass, SpreadsWhatIsBehindIt) {
    for (float roughness : {0.0f, 0.6f}) {
        Scene scene;
        add_object(scene, rough_glass(roughness, true), {-1, -1, 0}, {2, 0, 0}, {0, 2, 0});
        add_object(scene, lambertian(glm::vec3(0), glm::vec3(1)), {0.5f, -0.5f, -1}, {1, 0, 0}, {0, 1, 0});
        RayCaster rays(scene);
        const Measured m = measure(
            render_reference(rays, request_for({"full"}, camera_on({0, 0, 4}, {-0.3f, 0, 0}), 8, 256)),
            "full");
        if (roughness > 0.0f)
            EXPECT_GT(m.mean, 0.02);
        else
            EXPECT_EQ(m.mean, 0.0) << "the lamp is not on the straight line";
    }
}

} // namespace
} // namespace luxel
