// SPDX-License-Identifier: MIT
// Gathering against a sum on the CPU; regions as a partition of the pixels; interpolation against full
// gathering.
#include "techniques/vpl/vpl.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/error.h"
#include "scene/procedural.h"
#include "support/gpu.h"
#include "techniques/frame/renderer.h"

namespace luxel {
namespace {

using glm::dvec3, glm::vec3, glm::vec4;

// Keeps what the technique works with.
struct GatherProbe final : Technique {
    VplTechniqueOptions options;
    Frame frame;
    VplSenders senders;
    IsmPoints points;
    gpu::Image irradiance;
    Slot slot() const override { return Slot::post; }
    Contribution render(gpu::Recorder& recorder, const Frame& f) override {
        frame = f;
        senders.vpls = sample_vpls(recorder, reflective_shadow_maps(recorder, f, options.rsm), options.vpls);
        if (points.points)
            senders.ism = imperfect_shadow_maps(recorder, f, points, senders.vpls, options.ism);
        irradiance = vpl_irradiance(recorder, f, senders, options);
        return {};
    }
};

class VplGatherTest : public testing::GpuTest {
protected:
    GatherProbe probe(const Scene& scene, const VplTechniqueOptions& options, int width, int height) {
        GatherProbe p;
        p.options = options;
        FrameOptions frame;
        frame.emitter_lights = 0, frame.environment = EnvironmentMode::none;
        RenderRequest request{
            .camera = scene.cameras.at(0), .width = width, .height = height, .techniques = {&p}};
        Renderer(gpu(), scene, frame).render(request);
        return p;
    }
};

VplTechniqueOptions small() {
    VplTechniqueOptions o;
    o.gather = VplGather::full;
    o.rsm.size = 128, o.vpls.count = 96;
    return o;
}

constexpr double pi = 3.14159265358979;

// Irradiance of a disc of radiance 1 at v with normal m and radius sqrt(r2), as a vector, over pi r2: by the
// closed forms of two planes.
dvec3 disc_arrow(dvec3 v, dvec3 m, double r2) {
    const double h = -glm::dot(m, v);
    const dvec3 aside = v + h * m;
    const double a = glm::dot(v, v), s = std::max(glm::length(aside), 1e-9);
    const double q = std::sqrt((a + r2) * (a + r2) - 4.0 * r2 * s * s);
    const double facing = pi / 2.0 * (1.0 - (a - r2) / q), along = pi * h / (2.0 * s) * ((a + r2) / q - 1.0);
    return (along * aside / s - facing * m) / (pi * r2);
}

// What of it is above the horizon, by the sphere in its place.
double disc_kernel(dvec3 v, dvec3 n, dvec3 m, double r2) {
    if (glm::dot(m, v) >= 0.0) return 0.0;
    const dvec3 arrow = disc_arrow(v, m, r2);
    const double f = glm::length(arrow) * r2, t = glm::dot(n, glm::normalize(arrow)) / std::sqrt(f);
    if (t >= 1.0) return glm::dot(n, arrow);
    const double u = std::max(0.5 + 0.5 * t, 0.0), weight = 0.27 * f + 0.73 * std::pow(f, 8.0);
    return std::pow(f, 1.5) / r2 * ((1.0 - weight) * u * u * (0.7 + 0.3 * u) + weight * u);
}

// The sum in doubles, each kernel by its definition.
dvec3 brute_force(const std::vector<vec4>& texels, int count, dvec3 x, dvec3 n, dvec3 plane,
                  const VplTechniqueOptions& options) {
    dvec3 sum(0.0);
    for (std::size_t i = 0; i < std::size_t(count); ++i) {
        const dvec3 y(texels[3 * i]), m(texels[3 * i + 1]), flux(texels[3 * i + 2]);
        const dvec3 v = y - x;
        if (options.mode == VplMode::thesis) {
            sum += flux * std::abs(glm::dot(n, v) * glm::dot(m, v)) / (glm::dot(v, v) + 1e-3);
            continue;
        }
        if (options.mode == VplMode::disc) {
            const double before = std::min(-glm::dot(m, v), glm::dot(plane, v));
            if (before > double(shared::VPL_COPLANAR) * glm::length(v))
                sum += flux / pi * disc_kernel(v, n, m, double(texels[3 * i].w));
            continue;
        }
        const dvec3 w = glm::normalize(v);
        const double cosines = std::max(glm::dot(n, w), 0.0) * std::max(-glm::dot(m, w), 0.0);
        double kernel = cosines / (glm::dot(v, v) + double(texels[3 * i].w));
        if (options.clamp > 0.0f) kernel = std::min(cosines / glm::dot(v, v), double(options.clamp));
        if (glm::dot(plane, w) > 0.0) sum += flux / pi * kernel;
    }
    return sum;
}

TEST_F(VplGatherTest, FullIsTheSumOverTheLights) {
    for (int variant = 0; variant < 4; ++variant) {
        VplTechniqueOptions o = small();
        if (variant > 0) o.mode = VplMode::bounded;
        if (variant == 2) o.clamp = 2.0f;
        if (variant == 3) o.mode = VplMode::thesis;
        const GatherProbe p = probe(cornell(), o, 48, 40);
        const int count = gpu().read_all<int>(p.senders.vpls.count).at(0);
        EXPECT_GT(count, 60);
        const std::vector<vec4> texels = gpu().read_all<vec4>(p.senders.vpls.lights);
        const Image depth = gpu().read(p.frame.gbuffer.depth), normal = gpu().read(p.frame.gbuffer.normal),
                    plane = gpu().read(p.frame.gbuffer.geometric_normal), e = gpu().read(p.irradiance);
        for (int y = 0; y < e.height; ++y)
            for (int x = 0; x < e.width; ++x) {
                const float z = *depth.at(x, y);
                ASSERT_EQ(e.at(x, y)[3], z > 0.0f ? 1.0f : 0.0f);
                if (z <= 0.0f) continue;
                const dvec3 position(shared::world_position(p.frame.view, glm::vec2(x, y) + 0.5f, z));
                const dvec3 truth =
                    brute_force(texels, count, position, glm::normalize(dvec3(normal.rgb(x, y))),
                                glm::normalize(dvec3(plane.rgb(x, y))), o);
                for (int c = 0; c < 3; ++c)
                    ASSERT_NEAR(e.at(x, y)[c], truth[c], 1e-5 * truth[c]) << variant << " " << x << "," << y;
            }
    }
}

// Of n.v / |v|^4 over a disc; what is below the horizon or not.
double integral(const shared::Vpl& vpl, vec3 x, vec3 n, bool clipped) {
    double sum = 0.0;
    constexpr int steps = 400;
    const double radius = std::sqrt(double(vpl.bound));
    for (int i = 0; i < steps; ++i)
        for (int k = 0; k < steps; ++k) {
            const double r = radius * std::sqrt((i + 0.5) / steps), phi = 2.0 * pi * (k + 0.5) / steps;
            const dvec3 v = dvec3(vpl.position) + r * dvec3(std::cos(phi), 0, std::sin(phi)) - dvec3(x);
            const double c = glm::dot(v, dvec3(n));
            if (!clipped || c > 0.0) sum += c * v.y / std::pow(glm::dot(v, v), 2.0);
        }
    return sum / (steps * steps);
}

const shared::Vpl ceiling_disc{vec3(0.3f, 1.0f, -0.2f), 0.09f, vec3(0, -1, 0), vec3(1)};

// Below it, beside it, near its plane, and far away.
TEST(VplKernels, TheDiscIsTheIntegralOverItsArea) {
    const vec3 n = glm::normalize(vec3(-0.3f, 0.9f, 0.2f));
    for (vec3 x : {vec3(0.3f, 0.8f, -0.2f), vec3(0.45f, 0.6f, 0), vec3(1.1f, 0.4f, 0.3f), vec3(9, -7, 3)}) {
        const double kernel = double(shared::vpl_disc_kernel(ceiling_disc, x, n, n));
        EXPECT_NEAR(kernel / integral(ceiling_disc, x, n, false), 1.0, 2e-3) << x.x;
        EXPECT_EQ(shared::vpl_disc_kernel(ceiling_disc, vec3(x.x, 2, x.z), n, n), 0.0f); // from behind
    }
}

// On walls that the disc's middle is a little before: in a corner the bounded point is dark, the disc is not.
TEST(VplKernels, TheHorizonCutsTheDisc) {
    const vec3 n(1, 0, 0);
    for (float height : {0.03f, 0.1f, 0.3f})
        for (float before : {0.01f, 0.1f, 0.2f}) {
            const vec3 x = ceiling_disc.position - vec3(before, height, 0.05f);
            const double truth = integral(ceiling_disc, x, n, true);
            EXPECT_NEAR(double(shared::vpl_disc_kernel(ceiling_disc, x, n, n)), truth, 0.25 * truth)
                << height << " " << before;
        }
    shared::VplGatherParams p{};
    p.bounded = 1.0f, p.most = 1e30f;
    const vec3 corner = ceiling_disc.position - vec3(0.1f, 0.03f, 0);
    EXPECT_LT(double(shared::vpl_bounded_kernel(ceiling_disc, corner, n, n, p)),
              0.6 * integral(ceiling_disc, corner, n, true));
}

// A sheet that is lit from one side, seen from the other: rounding must not put the receiver before the disc.
TEST(VplKernels, ASheetIsDarkOnItsOtherSide) {
    const vec3 n = -ceiling_disc.normal;
    for (float rounding : {-1e-6f, 0.0f, 1e-6f, 2e-5f})
        for (float beside : {0.05f, 0.2f, 1.0f}) {
            const vec3 x = ceiling_disc.position + vec3(beside, -rounding, 0);
            EXPECT_EQ(shared::vpl_disc_kernel(ceiling_disc, x, n, n), 0.0f) << rounding << " " << beside;
        }
    const vec3 below = ceiling_disc.position - vec3(0.05f, 0.01f, 0);
    EXPECT_NEAR(double(shared::vpl_disc_kernel(ceiling_disc, below, n, n)),
                integral(ceiling_disc, below, n, true), 0.02 / 0.09);
}

// Every pixel of a surface is in one region, and no other is; also where the image is no multiple of a
// region.
TEST_F(VplGatherTest, RegionsPartitionThePixels) {
    struct RegionProbe final : Technique {
        VplRegionOptions options;
        VplRegions regions;
        gpu::Image depth;
        Slot slot() const override { return Slot::post; }
        Contribution render(gpu::Recorder& recorder, const Frame& frame) override {
            regions = vpl_regions(recorder, frame, options), depth = frame.gbuffer.depth;
            return {};
        }
    };
    constexpr int width = 150, height = 101;
    const Scene scene = shapes(ShapesLight::point);
    for (int levels : {1, 2, 5}) {
        RegionProbe p;
        p.options.levels = levels;
        RenderRequest request{
            .camera = scene.cameras.at(0), .width = width, .height = height, .techniques = {&p}};
        Renderer(gpu(), scene, {}).render(request);
        const Image depth = gpu().read(p.depth);
        const std::vector<int> counts = gpu().read_all<int>(p.regions.counts);
        std::vector<int> covered(width * height);
        for (std::size_t level = 0; level < counts.size(); ++level) {
            const std::vector<std::uint32_t> list = gpu().read_all<std::uint32_t>(p.regions.lists[level]);
            for (std::size_t i = 0; i < std::size_t(counts[level]); ++i)
                for (int k = 0; k < 1 << (2 * level); ++k) {
                    const int x = (int(list[i] & 0xffffu) << level) + k % (1 << level);
                    const int y = (int(list[i] >> 16u) << level) + k / (1 << level);
                    ASSERT_TRUE(x < width && y < height);
                    ++covered[std::size_t(y * width + x)];
                }
        }
        for (int i = 0; i < width * height; ++i)
            ASSERT_EQ(covered[std::size_t(i)], depth.data[std::size_t(i)] > 0.0f ? 1 : 0) << levels;
        if (levels > 1) {
            EXPECT_GT(counts[1], 20);
        }
    }
}

// Both discontinuities of a part are the whole's.
TEST(VplRegionMaths, DiscontinuitiesGrowTowardsCoarserLevels) {
    const shared::SurfaceRange part{vec3(0), {0.1f, 0.3f, 0}, 2.0f, 2.05f},
        whole{vec3(0), {0.1f, 0.3f, 0.2f}, 1.0f, 2.05f};
    EXPECT_FALSE(shared::is_discontinuous(part, 0.05f, 0.5f));
    EXPECT_TRUE(shared::is_discontinuous(part, 0.02f, 0.5f));
    EXPECT_TRUE(shared::is_discontinuous(part, 0.05f, 0.25f));
    EXPECT_TRUE(shared::is_discontinuous(whole, 0.05f, 0.5f));
    const shared::SurfaceRange border{vec3(0), vec3(0), 0.0f, 1.0f}; // beside the background
    EXPECT_TRUE(shared::is_discontinuous(border, 0.05f, 2.0f));
}

TEST_F(VplGatherTest, MultiresIsCloseToFull) {
    VplTechniqueOptions o = small();
    o.vpls.count = 256;
    const GatherProbe full = probe(cornell(), o, 192, 192);
    o.gather = VplGather::multires;
    const GatherProbe fast = probe(cornell(), o, 192, 192);
    const Image a = gpu().read(full.irradiance), b = gpu().read(fast.irradiance);
    double squares = 0.0, sum = 0.0;
    for (int y = 0; y < 192; ++y)
        for (int x = 0; x < 192; ++x) {
            ASSERT_EQ(a.at(x, y)[3], b.at(x, y)[3]);
            squares += std::pow(double(luminance(a.rgb(x, y) - b.rgb(x, y))), 2.0);
            sum += double(luminance(a.rgb(x, y)));
        }
    const double pixels = 192.0 * 192.0;
    EXPECT_LT(std::sqrt(squares / pixels), 0.02 * sum / pixels);

    // One level is full gathering.
    o.regions.levels = 1;
    const Image c = gpu().read(probe(cornell(), o, 192, 192).irradiance);
    EXPECT_EQ(a.data, c.data);
}

// Every combination of options draws without a complaint and adds light; without lamps there is none.
TEST_F(VplGatherTest, AllOptionsAddLight) {
    Scene lit = cornell(), dark = cornell();
    for (Material& m : dark.materials) m.emission = vec3(0);
    for (const char* use : {"vpl:vpls=32,rsm_size=64", "vpl:vpls=32,rsm_size=64,gather=multires",
                            "vpl:vpls=32,rsm_size=64,gather=multires,mode=bounded,clamp=3,pattern=grid",
                            "vpl:vpls=32,rsm_size=64,gather=multires,mode=thesis,levels=1",
                            "vpl:vpls=32,rsm_size=64,visibility=imperfect_shadow_maps,ism_points=256",
                            "vpl:vpls=32,rsm_size=64,visibility=imperfect_shadow_maps,gather=multires"})
        for (const Scene* scene : {&lit, &dark}) {
            std::unique_ptr<Technique> vpl = make_technique(parse_specification(use));
            const RenderResult r = Renderer(gpu(), *scene, {.emitter_lights = 0})
                                       .render({.camera = scene->cameras[0],
                                                .width = 40,
                                                .height = 30,
                                                .techniques = {vpl.get()},
                                                .images = {"vpl radiance"}});
            float sum = 0.0f;
            for (float v : r.images.at("vpl radiance").data) sum += v;
            const float alpha = 40.0f * 30.0f;
            if (scene == &lit) {
                EXPECT_GT(sum - alpha, 1.0f) << use;
            } else {
                EXPECT_EQ(sum, alpha) << use;
            }
        }
}

TEST_F(VplGatherTest, ShadowMapsAreForDiscs) {
    const Scene scene = cornell();
    std::unique_ptr<Technique> vpl =
        make_technique(parse_specification("vpl:mode=thesis,visibility=imperfect_shadow_maps"));
    try {
        Renderer(gpu(), scene, {.emitter_lights = 0})
            .render({.camera = scene.cameras[0], .width = 8, .height = 8, .techniques = {vpl.get()}});
        FAIL();
    } catch (const Error& e) {
        EXPECT_EQ(e.fault(), Fault::usage);
    }
}

} // namespace
} // namespace luxel
