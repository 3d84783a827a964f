// SPDX-License-Identifier: MIT
// The surface model: reciprocity, energy, known limits.
#include "shared/brdf.h"

#include <cmath>

#include <gtest/gtest.h>

#include "shared/random.h"
#include "shared/sampling.h"

namespace luxel::shared {
namespace {

vec3 hemisphere(uint i, uint key) {
    vec3 w = sample_sphere({uniform_float(hash3(i, key, 1u)), uniform_float(hash3(i, key, 2u))});
    return vec3(w.x, w.y, std::abs(w.z));
}

// Directional albedo of the specular lobe by visible-normal sampling.
double specular_albedo(const Brdf& b, vec3 wo, int count) {
    double sum = 0.0;
    for (uint i = 0; i < uint(count); ++i) {
        vec3 wi = reflect(-wo, sample_visible_normal(wo, b.alpha, hammersley(i, uint(count))));
        if (wi.z <= 0.0f) continue;
        vec3 h = normalize(wi + wo), n(0, 0, 1);
        float pdf = ggx_reflection_pdf(ggx_d(n, h, b.alpha), wo.z, b.alpha);
        sum += double(evaluate_specular(b, n, wo, wi).g * wi.z / pdf);
    }
    return sum / count;
}

TEST(Brdf, IsReciprocal) {
    Brdf b = make_brdf(vec3(0.8f, 0.5f, 0.2f), 0.3f, 0.4f, 1.5f, 1.0f, vec3(1.0f));
    for (uint i = 0; i < 2000; ++i) {
        vec3 wo = hemisphere(i, 1), wi = hemisphere(i, 2), n(0, 0, 1);
        vec3 forth = evaluate_brdf(b, n, wo, wi), back = evaluate_brdf(b, n, wi, wo);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(forth[c], back[c], 1e-4f * std::max(1.0f, forth[c]));
    }
}

// No direction may reflect more than arrives. The diffuse lobe takes the mean of the Fresnel term over
// directions instead of its value at each, so at grazing angles a rough dielectric may exceed 1 by the
// difference.
TEST(Brdf, ConservesEnergyOverAllDirections) {
    for (float metallic : {0.0f, 0.5f, 1.0f})
        for (float roughness : {0.1f, 0.3f, 0.6f, 1.0f}) {
            Brdf b = make_brdf(vec3(1.0f), metallic, roughness, 1.5f, 1.0f, vec3(1.0f));
            double mean = 0.0; // cosine-weighted over the hemisphere: the reflectance of uniform light
            const int steps = 64;
            for (int i = 0; i < steps; ++i) {
                float cos_o = std::sqrt((float(i) + 0.5f) / float(steps));
                vec3 wo(std::sqrt(1.0f - cos_o * cos_o), 0.0f, cos_o);
                mean += (double(b.diffuse.g) + specular_albedo(b, wo, 512)) / steps;
            }
            EXPECT_LE(mean, 1.003) << "metallic " << metallic << ", roughness " << roughness;
            EXPECT_GT(mean, metallic == 0.0f ? 0.85 : 0.3) << "a white dielectric is nearly white";
        }
}

// White furnace with one bounce between microfacets: a smooth white metal returns all, a rough one loses what
// its facets pass on to each other. At width 1 the lobe is 1 / (2 pi (cos_i + cos_o)), whose albedo is
// elementary.
TEST(Brdf, WhiteMetalReflectsWhatItShould) {
    Brdf smooth = make_brdf(vec3(1.0f), 1.0f, 0.1f, 1.5f, 1.0f, vec3(1.0f));
    Brdf rough = make_brdf(vec3(1.0f), 1.0f, 1.0f, 1.5f, 1.0f, vec3(1.0f));
    for (double mu : {0.3, 0.6, 0.95}) {
        vec3 wo(float(std::sqrt(1.0 - mu * mu)), 0.0f, float(mu));
        EXPECT_NEAR(specular_albedo(rough, wo, 16384), 1.0 - mu * std::log((1.0 + mu) / mu), 1e-3);
        EXPECT_NEAR(specular_albedo(smooth, wo, 16384), 1.0, 5e-3);
    }
}

// The sampled weight is F G2/G1 <= 1 at any width; a cancelled sine in D would break this for narrow lobes.
TEST(Brdf, NarrowLobesKeepTheirDigits) {
    Brdf b = make_brdf(vec3(1.0f), 1.0f, 0.0f, 1.5f, 1.0f, vec3(1.0f));
    EXPECT_FLOAT_EQ(b.alpha, MIN_ALPHA);
    vec3 wo = normalize(vec3(0.3f, -0.4f, 0.7f));
    EXPECT_NEAR(specular_albedo(b, wo, 4096), 1.0, 1e-3);
    float peak = ggx_d(vec3(0, 0, 1), vec3(0, 0, 1), MIN_ALPHA);
    EXPECT_NEAR(peak * PI * MIN_ALPHA * MIN_ALPHA, 1.0f, 1e-5f);

    // One width off the peak the distribution has fallen to a quarter.
    vec3 h = normalize(vec3(MIN_ALPHA, 0, 1));
    EXPECT_NEAR(ggx_d(vec3(0, 0, 1), h, MIN_ALPHA) / peak, 0.25f, 1e-3f);
}

// D is normalized: projected onto the plane it covers it once.
TEST(Brdf, NormalDistributionIsNormalized) {
    for (float alpha : {0.2f, 0.5f, 1.0f}) {
        double sum = 0.0;
        const int steps = 20000;
        for (int i = 0; i < steps; ++i) {
            double z = (i + 0.5) / steps;
            vec3 h(float(std::sqrt(1.0 - z * z)), 0.0f, float(z));
            sum += double(ggx_d(vec3(0, 0, 1), h, alpha)) * z * 2.0 * double(PI) / steps;
        }
        EXPECT_NEAR(sum, 1.0, 1e-3) << alpha;
    }
}

TEST(Brdf, DielectricFresnelHasItsKnownValues) {
    EXPECT_NEAR(fresnel_dielectric(1.0f, 1.5f), 0.04f, 1e-6f);
    EXPECT_NEAR(fresnel_dielectric(0.0f, 1.5f), 1.0f, 1e-6f);
    EXPECT_EQ(fresnel_dielectric(0.5f, 1.0f / 1.5f), 1.0f) << "total internal reflection";
    EXPECT_NEAR(fresnel_dielectric(0.7f, 1.0f), 0.0f, 1e-6f) << "no interface";
    // At Brewster's angle only half of the light (one polarization) reflects: r_s^2 / 2.
    float brewster = std::cos(std::atan(1.5f));
    float rs = (1.5f * 1.5f - 1.0f) / (1.5f * 1.5f + 1.0f);
    EXPECT_NEAR(fresnel_dielectric(brewster, 1.5f), 0.5f * rs * rs, 1e-5f);
}

TEST(Brdf, DiffuseLobeCarriesWhatFresnelLeaves) {
    Brdf dark = make_brdf(vec3(1.0f), 0.0f, 1.0f, 1.5f, 0.0f, vec3(1.0f));
    EXPECT_EQ(dark.diffuse, vec3(1.0f)) << "no specular layer";
    Brdf b = make_brdf(vec3(1.0f), 0.0f, 1.0f, 1.5f, 1.0f, vec3(1.0f));
    EXPECT_NEAR(b.diffuse.r, 1.0f - (0.04f + 0.96f / 21.0f), 1e-6f);
    EXPECT_EQ(make_brdf(vec3(1.0f), 1.0f, 1.0f, 1.5f, 1.0f, vec3(1.0f)).diffuse, vec3(0.0f)) << "metal";
    Brdf half = scale_brdf(b, 0.5f);
    EXPECT_FLOAT_EQ(half.f90.r, 0.5f);
    EXPECT_FLOAT_EQ(half.diffuse.r, 0.5f * b.diffuse.r);
}

TEST(Brdf, FacingNormalLeavesGoodNormalsAlone) {
    vec3 ng(0, 0, 1), wo = normalize(vec3(1, 0, 0.3f)), good = normalize(vec3(0.1f, 0.2f, 1));
    EXPECT_EQ(facing_normal(good, ng, wo), good);
    for (uint i = 0; i < 1000; ++i) {
        vec3 n = sample_sphere({uniform_float(hash2(i, 1u)), uniform_float(hash2(i, 2u))});
        vec3 bent = facing_normal(n, ng, wo);
        EXPECT_GT(dot(bent, ng), 0.0f);
        EXPECT_GT(dot(bent, wo), 0.0f);
        EXPECT_NEAR(length(bent), 1.0f, 1e-5f);
    }
}

} // namespace
} // namespace luxel::shared
