// SPDX-License-Identifier: MIT
// Furnaces: in light of radiance 1 from everywhere a white surface shows 1, whatever its roughness, the view
// and the shading normal.
#include <cmath>

#include <gtest/gtest.h>

#include "shared/clearcoat.h"
#include "shared/sampling.h"

namespace luxel::shared {
namespace {

constexpr float roughnesses[] = {0.02f, 0.05f, 0.1f, 0.15f, 0.23f, 0.3f,
                                 0.42f, 0.5f,  0.6f, 0.75f, 0.9f,  1.0f};
constexpr float cosines[] = {0.02f, 0.05f, 0.1f, 0.2f, 0.33f, 0.5f, 0.7f, 0.85f, 0.95f, 1.0f};
const vec3 up(0, 0, 1);

vec3 at_cosine(float c) { return {std::sqrt(1.0f - c * c), 0.0f, c}; }

// The specular lobe's integral over the hemisphere of ng, by its own sampling; n.wo > 0.
vec3 specular_furnace(const Brdf& b, vec3 n, vec3 ng, vec3 wo, uint count) {
    const mat3 frame = frame_around(n);
    vec3 sum(0.0f);
    for (uint i = 0; i < count; ++i) {
        const vec3 h = frame * sample_visible_normal(wo * frame, b.alpha, hammersley(i, count));
        vec3 wi = reflect(-wo, h);
        if (dot(wi, n) <= 0.0f) continue;
        wi = above_horizon(wi, ng);
        // The density has a term for each of the two directions that lead to wi.
        float pdf = 0.0f;
        for (const vec3& w : {wi, mirrored_at_horizon(wi, ng)})
            if (dot(w, n) > 0.0f)
                pdf += ggx_reflection_pdf(ggx_d(n, normalize(w + wo), b.alpha), dot(n, wo), b.alpha);
        sum += reflect_specular(b, n, ng, wo, wi) / pdf;
    }
    return sum / float(count);
}

// Lambert's lobe around n over the hemisphere of ng.
float diffuse_furnace(vec3 n, vec3 ng, uint count) {
    const mat3 frame = frame_around(n);
    float sum = 0.0f;
    for (uint i = 0; i < count; ++i)
        if (dot(frame * sample_cosine_hemisphere(hammersley(i, count)), ng) > 0.0f) sum += 1.0f;
    return sum / float(count) * 2.0f / (1.0f + dot(n, ng)); // the diffuse share below the horizon is lost
}

TEST(Energy, DirectionalAlbedoIsItsIntegral) {
    for (float roughness : roughnesses)
        for (float c : cosines) {
            const float alpha = std::max(roughness * roughness, MIN_ALPHA);
            const DirectionalAlbedo a = ggx_directional_albedo(c, alpha);
            const Brdf whole{vec3(0), vec3(1), vec3(1), alpha}, grazing{vec3(0), vec3(0), vec3(1), alpha};
            const double all = double(specular_furnace(whole, up, up, at_cosine(c), 8192).x);
            EXPECT_NEAR(a.whole, all, 0.0035 * all) << "cosine " << c << ", roughness " << roughness;
            EXPECT_NEAR(a.grazing, specular_furnace(grazing, up, up, at_cosine(c), 8192).x, 0.006)
                << "cosine " << c << ", roughness " << roughness;
        }
}

TEST(Energy, WhiteSurfacesShowAllOfUniformLight) {
    for (float metallic : {0.0f, 0.5f, 1.0f})
        for (float ior : {1.0f, 1.33f, 1.5f, 2.4f})
            for (float roughness : roughnesses)
                for (float c : cosines) {
                    const Brdf b = make_brdf_toward(c, vec3(1), metallic, roughness, ior, 1.0f, vec3(1));
                    const float shown = b.diffuse.x + specular_furnace(b, up, up, at_cosine(c), 2048).x;
                    EXPECT_NEAR(shown, 1.0f, 0.01f) << "metallic " << metallic << ", index " << ior
                                                    << ", roughness " << roughness << ", cosine " << c;
                }
}

TEST(Energy, ColoredSurfacesShowAtMostAllAndNoLessThanWithOneScattering) {
    const vec3 color(0.9f, 0.5f, 0.1f);
    for (float metallic : {0.0f, 0.6f, 1.0f})
        for (float roughness : roughnesses)
            for (float c : cosines) {
                const Brdf b = make_brdf_toward(c, color, metallic, roughness, 1.5f, 1.0f, vec3(1)),
                           once = make_brdf(color, metallic, roughness, 1.5f, 1.0f, vec3(1));
                const vec3 lobe = specular_furnace(b, up, up, at_cosine(c), 1024),
                           lobe_once = specular_furnace(once, up, up, at_cosine(c), 1024);
                for (int k = 0; k < 3; ++k) {
                    EXPECT_LE(b.diffuse[k] + lobe[k], 1.01f);
                    EXPECT_GE(lobe[k], lobe_once[k] - 1e-5f);
                }
            }
}

TEST(Energy, CoatsLeaveWhiteSurfacesWhite) {
    for (float metallic : {0.0f, 0.4f, 1.0f})
        for (float share : {0.0f, 0.5f, 1.0f})
            for (float coat_roughness : {0.0f, 0.3f, 1.0f})
                for (float roughness : {0.1f, 0.6f})
                    for (float c : cosines) {
                        const Brdf below =
                            make_brdf_toward(c, vec3(1), metallic, roughness, 1.5f, 1.0f, vec3(1));
                        const Coat coat = make_coat(share, coat_roughness, c, 1.0f);
                        const Brdf one = coated_by_one_lobe(below, coat, share, metallic, c);
                        const double two_lobes =
                            double(coat.passes) *
                                (double(below.diffuse.x) +
                                 double(specular_furnace(below, up, up, at_cosine(c), 1024).x)) +
                            double(specular_furnace(coat.lobe, up, up, at_cosine(c), 1024).x);
                        EXPECT_NEAR(two_lobes, 1.0, 0.012) << "coat " << share << ", cosine " << c;
                        EXPECT_NEAR(one.diffuse.x + specular_furnace(one, up, up, at_cosine(c), 1024).x, 1.0f,
                                    0.015f)
                            << "coat " << share << ", cosine " << c;
                        if (share > 0.0f) continue;
                        EXPECT_NEAR(one.f0.x, below.f0.x, 1e-5f) << "without a coat nothing changes";
                        EXPECT_NEAR(one.diffuse.x, below.diffuse.x, 1e-5f);
                    }
}

// The diffuse lobe's mean over the views is about what the older model gives it from everywhere.
TEST(Energy, DiffuseAlbedoKeepsItsMean) {
    const Brdf once = make_brdf(vec3(1), 0.0f, 0.1f, 1.5f, 1.0f, vec3(1));
    double mean = 0.0;
    for (int i = 0; i < 1000; ++i)
        mean += double(make_brdf_toward(std::sqrt((float(i) + 0.5f) / 1000.0f), vec3(1), 0.0f, 0.1f, 1.5f,
                                        1.0f, vec3(1))
                           .diffuse.x) /
                1000.0;
    EXPECT_NEAR(mean, double(once.diffuse.x), 0.005);
}

// Normal maps of slope s: shading normals at that angle, around all azimuths, as far as wo sees the surface.
template <class Test> void over_normal_maps(Test test) {
    for (float slope : {0.5f, 1.0f, 2.0f, 4.0f})
        for (float c : {0.1f, 0.4f, 0.8f, 1.0f})
            for (int k = 0; k < 8; ++k) {
                const float phi = 2.0f * PI * (float(k) + 0.3f) / 8.0f;
                const vec3 n = normalize(vec3(slope * std::cos(phi), slope * std::sin(phi), 1.0f));
                test(n, at_cosine(c));
            }
}

TEST(Energy, NormalMapsOnMetalLoseNothing) {
    over_normal_maps([](vec3 map, vec3 wo) {
        const vec3 n = bent_normal(map, up, wo, 1.0f);
        for (float roughness : {0.0f, 0.1f, 0.3f, 0.6f, 1.0f}) {
            const Brdf b = make_brdf_toward(dot(n, wo), vec3(1), 1.0f, roughness, 1.5f, 1.0f, vec3(1));
            EXPECT_NEAR(specular_furnace(b, n, up, wo, 2048).x, 1.0f, 0.01f) << "roughness " << roughness;
        }
    });
}

TEST(Energy, NormalMapsOnDiffuseSurfacesLoseNothing) {
    over_normal_maps([](vec3 map, vec3 wo) {
        const vec3 n = bent_normal(map, up, wo, 0.0f);
        EXPECT_NEAR(diffuse_furnace(n, up, 8192), 1.0f, 0.003f);
    });
}

TEST(Energy, MirroredDirectionsStayAboveTheSurface) {
    over_normal_maps([](vec3 map, vec3 wo) {
        const vec3 n = reflecting_normal(map, up, wo);
        const vec3 r = reflect(-wo, n);
        const float least = std::min(wo.z, LEAST_REFLECTED_COSINE);
        EXPECT_GE(r.z, least - 1e-5f);
        EXPECT_GT(dot(n, wo), 0.0f);
        const bool good = reflect(-wo, map).z >= least && dot(map, wo) > 0.0f;
        EXPECT_EQ(good, n == map) << "good normals stay, others do not";
        if (good) return;
        // No less turned normal on the way does: between the map's and this one all are below.
        EXPECT_NEAR(r.z, least, 1e-4f);
        for (float share : {0.1f, 0.5f, 0.9f}) {
            const vec3 between = normalize(mix(n, map, share));
            EXPECT_LT(reflect(-wo, between).z, least + 1e-5f);
        }
    });
    // Normals that turn away altogether.
    EXPECT_EQ(reflecting_normal(-up, up, at_cosine(0.5f)), up);
    EXPECT_GT(
        reflect(-at_cosine(0.3f), reflecting_normal(normalize(vec3(1, 0.2f, -0.5f)), up, at_cosine(0.3f))).z,
        0.0f);
}

} // namespace
} // namespace luxel::shared
