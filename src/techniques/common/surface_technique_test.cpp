// SPDX-License-Identifier: MIT
// The surface slot: closed forms of flat and inclined reliefs, and the tessellated height field drawn by the
// same frame.
#include <cmath>
#include <map>

#include <gtest/gtest.h>

#include "scene/height_field.h"
#include "scene/procedural.h"
#include "support/gpu.h"
#include "techniques/frame/renderer.h"

namespace luxel {
namespace {

const char* const all_uses[] = {"parallax:mode=plain,depth=on",
                                "parallax:mode=offset_limit,depth=on",
                                "parallax:mode=slope,depth=on",
                                "parallax:mode=iterated,depth=on",
                                "binary:depth=on",
                                "secant:depth=on",
                                "relief:depth=on",
                                "parallax_occlusion:depth=on"};
const std::vector<std::string> gbuffer_images = {"diffuse", "normal", "geometric_normal", "depth", "direct"};

class SurfaceTest : public testing::GpuTest {
protected:
    // use: "" for the frame alone.
    RenderResult render(const Scene& scene, const std::string& use, int width = 128, int height = 96,
                        bool mipmaps = false) {
        FrameOptions options;
        options.shadow = ShadowMode::hard, options.shadow_size = 512, options.mipmaps = mipmaps;
        RenderRequest request{
            .camera = scene.cameras.at(0), .width = width, .height = height, .images = gbuffer_images};
        std::unique_ptr<Technique> technique;
        if (!use.empty()) {
            technique = make_technique(parse_specification(use));
            request.techniques = {technique.get()};
        }
        return Renderer(gpu(), scene, options).render(request);
    }
};

// The relief scene with other heights in both of its maps.
Scene with_heights(const std::function<std::uint8_t(int x, int y)>& height) {
    Scene scene = relief();
    for (const Material& m : scene.materials) {
        if (!m.has_relief()) continue;
        Pixels& pixels = scene.textures[std::size_t(m.height_texture.texture)].pixels;
        for (int y = 0; y < pixels.height; ++y)
            for (int x = 0; x < pixels.width; ++x)
                pixels.rgba[std::size_t(y * pixels.width + x) * 4] = height(x, y);
    }
    return scene;
}

// Mean of |a - b| per value, over pixels that both see.
double mean_difference(const Image& a, const Image& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.data.size(); ++i) sum += double(std::abs(a.data[i] - b.data[i]));
    return sum / double(a.data.size());
}

TEST_F(SurfaceTest, AFlatMapChangesNoBit) {
    const Scene flat = with_heights([](int, int) { return std::uint8_t(255); });
    for (bool mipmaps : {false, true}) {
        const RenderResult without = render(flat, "", 128, 96, mipmaps);
        for (const char* use : all_uses) {
            const RenderResult with = render(flat, use, 128, 96, mipmaps);
            for (const std::string& name : gbuffer_images)
                EXPECT_EQ(mean_difference(with.images.at(name), without.images.at(name)), 0.0)
                    << use << " " << name;
        }
    }
}

TEST_F(SurfaceTest, WithoutATechniqueMapsAreNotLookedAt) {
    Scene plain = relief();
    for (Material& m : plain.materials) m.height_texture = {}, m.height_scale = 0.0f;
    const RenderResult ignored = render(relief(), ""), without = render(plain, "");
    for (const std::string& name : gbuffer_images)
        EXPECT_EQ(mean_difference(ignored.images.at(name), without.images.at(name)), 0.0) << name;
}

// A constant height is the polygon, moved straight back: same texture coordinates, light and shadows.
TEST_F(SurfaceTest, AConstantHeightMovesThePolygon) {
    const Scene sunk = with_heights([](int, int) { return std::uint8_t(102); });
    Scene moved = sunk;
    for (Instance& instance : moved.instances) {
        const Mesh& mesh = moved.meshes[std::size_t(instance.mesh)];
        Material& m = moved.materials[std::size_t(mesh.material)];
        instance.transform[3] -= glm::vec4(mesh.normals[0] * (m.height_scale * 0.6f), 0.0f);
        m.height_texture = {};
        if (m.height_scale == 0.0f) instance.transform = glm::mat4(1.0f);
    }
    const RenderResult truth = render(moved, "");
    for (const char* use :
         {"parallax:mode=plain,depth=on", "parallax:mode=slope,depth=on", "parallax:mode=iterated,depth=on",
          "secant", "parallax_occlusion", "binary:steps=20", "relief:refine=20"}) {
        const RenderResult ours = render(sunk, use);
        // A few pixels at the ball's outline and at shadows' borders fall to the other side.
        EXPECT_LT(mean_difference(ours.images.at("depth"), truth.images.at("depth")), 1e-4) << use;
        EXPECT_LT(mean_difference(ours.images.at("diffuse"), truth.images.at("diffuse")), 2e-3) << use;
        EXPECT_LT(mean_difference(ours.images.at("normal"), truth.images.at("normal")), 1e-3) << use;
        EXPECT_LT(mean_difference(ours.images.at("direct"), truth.images.at("direct")), 0.01) << use;
    }
}

TEST_F(SurfaceTest, ReliefsLieBehindTheirPolygons) {
    const Scene scene = relief();
    const Image macro = render(scene, "").images.at("depth");
    for (const char* use : all_uses) {
        const Image depth = render(scene, use).images.at("depth");
        double deeper = 0;
        for (std::size_t i = 0; i < depth.data.size(); ++i) {
            ASSERT_GE(depth.data[i], macro.data[i] * 0.999999f) << use;
            deeper += double(depth.data[i] > macro.data[i] * 1.000001f);
        }
        EXPECT_GT(deeper / double(depth.data.size()), 0.5) << use;
        std::string without = use;
        without.replace(without.find("depth=on"), 8, "depth=off");
        const Image still = render(scene, without).images.at("depth");
        EXPECT_EQ(mean_difference(still, macro), 0.0) << use;
    }
}

// What each technique finds against the tessellated height field that the frame draws as triangles, half a
// texel long. Mean differences of albedo when this was written: plain .0185, slope .0169, offset_limit .0202,
// secant .0074, iterated .0048, binary .0036, relief and parallax_occlusion .00013.
TEST_F(SurfaceTest, SearchesComeNearerToTheTessellationThanGuesses) {
    const Scene scene = relief();
    const RenderResult truth = render(with_height_fields(scene, 0.00625f), "", 192, 144);
    std::map<std::string, double> depth, albedo, normal;
    for (const std::string use : all_uses) {
        const RenderResult ours = render(scene, use, 192, 144);
        const std::string name = use.substr(0, use.find("depth=on") - 1);
        depth[name] = mean_difference(ours.images.at("depth"), truth.images.at("depth"));
        albedo[name] = mean_difference(ours.images.at("diffuse"), truth.images.at("diffuse"));
        normal[name] = mean_difference(ours.images.at("normal"), truth.images.at("normal"));
    }
    for (auto* error : {&depth, &albedo, &normal}) {
        const auto of = [error](const std::string& name) { return error->at(name); };
        EXPECT_LT(of("parallax:mode=slope"), of("parallax:mode=plain"));
        EXPECT_LT(of("parallax:mode=iterated"), 0.5 * of("parallax:mode=plain"));
        EXPECT_LT(of("secant"), 0.5 * of("parallax:mode=plain"));
        EXPECT_LT(of("binary"), 0.8 * of("parallax:mode=iterated"));
        for (const char* name : {"relief", "parallax_occlusion"}) EXPECT_LT(of(name), 0.4 * of("binary"));
    }

    // Twice what was measured: meters, and shares of albedo.
    for (const char* name : {"relief", "parallax_occlusion"}) {
        EXPECT_LT(depth[name], 2e-4) << name;
        EXPECT_LT(albedo[name], 2.6e-4) << name;
        EXPECT_LT(normal[name], 1.8e-3) << name;
    }
}

// Occlusion has no code for reliefs: it reads their depth and normals, and darkens their grooves as those of
// the tessellation.
TEST_F(SurfaceTest, OcclusionSeesTheRelief) {
    const Scene scene = relief(), detailed = with_height_fields(scene);
    const auto accessibility = [this](const Scene& s, const char* use) {
        std::vector<std::unique_ptr<Technique>> techniques;
        RenderRequest request{.camera = s.cameras.at(0), .width = 128, .height = 96, .accessibility = true};
        for (const char* name : {use, "volumetric:radius=0.1,samples=16"}) {
            if (!*name) continue;
            techniques.push_back(make_technique(parse_specification(name)));
            request.techniques.push_back(techniques.back().get());
        }
        FrameOptions options;
        options.shadow_size = 256, options.mipmaps = false;
        return Renderer(gpu(), s, options).render(request).accessibility;
    };
    const Image truth = accessibility(detailed, "");
    const double without = mean_difference(accessibility(scene, ""), truth);
    EXPECT_GT(without, 0.004); // half of what was measured
    EXPECT_LT(mean_difference(accessibility(scene, "relief"), truth), 0.1 * without);
}

} // namespace
} // namespace luxel
