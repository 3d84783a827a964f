// SPDX-License-Identifier: MIT
// Energy of photons: from a lamp over a plane mirror to the ceiling, in closed form, and from discs to
// pixels.
#include <gtest/gtest.h>

#include "scene/procedural.h"
#include "support/gpu.h"
#include "support/mirror_scene.h"
#include "techniques/frame/renderer.h"
#include "techniques/technique.h"

namespace luxel {
namespace {

using glm::vec3;

using namespace testing;

constexpr int side = 128;

// With the camera low, so that it sees all that the mirror lights.
Scene mirror_scene(float half_width, float half_length) {
    return mirror_under_ceiling(
        {.half_width = half_width, .half_length = half_length, .camera_height = 0.3f, .yfov = 2.2f});
}

// Flux that the mirror sends on: its irradiance by the lamp, over its area.
double sent(float half_width, float half_length) {
    constexpr int n = 400;
    double sum = 0;
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
            const vec3 on((2 * (float(i) + 0.5f) / n - 1) * half_width, 0,
                          (2 * (float(j) + 0.5f) / n - 1) * half_length);
            const vec3 d = lamp - on;
            const float cosine = d.y / glm::length(d);
            sum += lamp_intensity * cosine / glm::dot(d, d) *
                   shared::fresnel_schlick(vec3(mirror_f0), vec3(1), cosine).g;
        }
    return sum * 4 * half_width * half_length / (n * n);
}

class PhotonMapTest : public GpuTest {
protected:
    Image caustics(const Scene& scene, const std::string& use) {
        FrameOptions options;
        options.emitter_lights = 0, options.environment = EnvironmentMode::none, options.shadow_size = 64;
        auto technique = make_technique(parse_specification(use));
        RenderRequest request{.camera = scene.cameras.at(0),
                              .width = side,
                              .height = side,
                              .techniques = {technique.get()},
                              .images = {"caustics"}};
        return Renderer(gpu(), scene, options).render(request).images.at("caustics");
    }
    // Irradiance times the area that each pixel sees of the ceiling.
    double received(const Scene& scene, const std::string& use) {
        const Image image = caustics(scene, use);
        const CameraBasis b = camera_basis(scene.cameras[0], side, side);
        const float pixel = 2 * glm::length(b.right) / side * (ceiling - b.position.y);
        double sum = 0;
        for (std::size_t i = 0; i < image.pixels(); ++i) sum += image.data[4 * i + 1];
        return sum * shared::PI / ceiling_albedo * pixel * pixel;
    }
};

TEST_F(PhotonMapTest, TheMirrorsFluxArrives) {
    const Scene scene = mirror_scene(half_mirror, half_mirror);
    const double all = sent(half_mirror, half_mirror);
    for (const char* use : {"photon_map", "photon_map:kernel=gaussian", "photon_map:kernel=cone",
                            "photon_map:photons=400", "photon_map:capture=box", "photon_map:scale=2"})
        EXPECT_NEAR(received(scene, use) / all, 1.0, 0.02) << use;
}

// A lobe of visible normals spreads the light a little and loses next to none.
TEST_F(PhotonMapTest, ARoughMirrorSendsAsMuch) {
    Scene scene = mirror_scene(half_mirror, half_mirror);
    const Image sharp = caustics(scene, "photon_map");
    scene.materials[0].roughness = 0.1f;
    const Image rough = caustics(scene, "photon_map");
    double change = 0, all = 0, all_rough = 0;
    for (std::size_t i = 0; i < sharp.data.size(); i += 4) {
        all += sharp.data[i], all_rough += rough.data[i];
        change += std::abs(sharp.data[i] - rough.data[i]);
    }
    EXPECT_NEAR(all_rough / all, 1.0, 0.02);
    EXPECT_GT(change / all, 0.05);
}

// Away from the outline the ceiling is lit as by the lamp's image: discs of a regular beam add up to a smooth
// whole.
TEST_F(PhotonMapTest, TheBeamOfAPlaneMirrorIsSmooth) {
    const Scene scene = mirror_scene(half_mirror, half_mirror);
    const CameraBasis b = camera_basis(scene.cameras[0], side, side);
    for (const char* use : {"photon_map:photons=2000", "photon_map:photons=2000,disc=beam"}) {
        const Image image = caustics(scene, use);
        double error = 0, count = 0;
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x) {
                const vec3 d = pixel_direction(b, side, side, {float(x) + 0.5f, float(y) + 0.5f});
                const vec3 at = b.position + d * ((ceiling - b.position.y) / d.y);
                const vec3 on_mirror = on_mirror_toward(at);
                if (std::max(std::abs(on_mirror.x), std::abs(on_mirror.z)) > 0.8f * half_mirror) continue;
                const float exact = irradiance_by_mirror(at);
                error += std::abs(image.rgb(x, y).g * shared::PI / ceiling_albedo / exact - 1.0f), ++count;
            }
        ASSERT_GT(count, 200) << use;
        EXPECT_LT(error / count, 0.03) << use;
    }
}

// The same photons in each frame, whatever order their threads ran in.
TEST_F(PhotonMapTest, FramesDoNotFlicker) {
    const Image once = caustics(glass_sphere(), "photon_map:photons=500,both=off"),
                again = caustics(glass_sphere(), "photon_map:photons=500,both=off");
    double most = 0, apart = 0;
    for (std::size_t i = 0; i < once.data.size(); ++i)
        most = std::max(most, double(once.data[i])),
        apart = std::max(apart, std::abs(double(once.data[i]) - double(again.data[i])));
    EXPECT_GT(most, 0.1);
    EXPECT_LT(apart, 1e-5 * most); // sums of floats in another order
}

// A strip of three pixels of the shadow map is nowhere specular over a whole cell; the thesis's way loses it.
TEST_F(PhotonMapTest, AThinMirrorKeepsItsLight) {
    const Scene scene = mirror_scene(0.0125f, half_mirror);
    const double all = sent(0.0125f, half_mirror);
    const std::string few = "photon_map:photons=50";
    EXPECT_NEAR(received(scene, few) / all, 1.0, 0.1); // three pixels stand for 3.2
    EXPECT_LT(received(scene, few + ",mixed=off") / all, 0.1);
}

} // namespace
} // namespace luxel
