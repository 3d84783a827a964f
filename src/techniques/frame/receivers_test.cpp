// SPDX-License-Identifier: MIT
// Two techniques of one slot that light different surfaces.
#include <gtest/gtest.h>

#include "core/error.h"
#include "scene/procedural.h"
#include "support/gpu.h"
#include "techniques/frame/renderer.h"

namespace luxel {
namespace {

class ReceiversTest : public testing::GpuTest {
protected:
    Image render(const Scene& scene, const std::vector<std::string>& uses) {
        std::vector<std::unique_ptr<Technique>> techniques;
        RenderRequest request{.camera = scene.cameras.at(0), .width = 64, .height = 48};
        for (const std::string& use : uses) {
            techniques.push_back(make_technique(parse_specification(use)));
            request.techniques.push_back(techniques.back().get());
        }
        return Renderer(gpu(), scene, {.emitter_lights = 0}).render(request).radiance;
    }
};

const std::string vpl = "vpl:vpls=64,gather=full,visibility=none,importance=0", envmap = "envmap:size=32";

TEST_F(ReceiversTest, WallsAndObjectsAreLitByTheirOwn) {
    const Scene scene = ball_room(BallPlace::corner, 1.0f, BallLight::lamps);
    const Image direct = render(scene, {}), walls = render(scene, {vpl}), ball = render(scene, {envmap});
    for (const Image& both : {render(scene, {vpl, envmap}), render(scene, {envmap, vpl})}) {
        int of_ball = 0, of_walls = 0;
        for (int y = 0; y < 48; ++y)
            for (int x = 0; x < 64; ++x) {
                const bool object = ball.rgb(x, y) != direct.rgb(x, y);
                ++(object ? of_ball : of_walls);
                const glm::vec3 expected = object ? ball.rgb(x, y) : walls.rgb(x, y);
                ASSERT_LT(glm::length(both.rgb(x, y) - expected), 1e-5f * glm::length(expected))
                    << x << " " << y;
            }
        EXPECT_GT(of_ball, 50);
        EXPECT_GT(of_walls, 500);
    }
}

TEST_F(ReceiversTest, TheSameSurfacesAreAnError) {
    const Scene scene = ball_room(BallPlace::corner, 1.0f, BallLight::lamps);
    EXPECT_THROW(render(scene, {vpl, "isr"}), Error);
    EXPECT_THROW(render(scene, {vpl, "envmap:probes=grid"}), Error);
    EXPECT_THROW(render(scene, {envmap, envmap}), Error);
}

// What the occlusion slot leaves open dims light from afar, and nothing else.
TEST_F(ReceiversTest, OcclusionDimsLightFromAfar) {
    const Scene scene = ball_room(BallPlace::corner, 0.1f, BallLight::lamps);
    const std::string occlusion = "gtao:radius=0.5";
    const Image direct = render(scene, {}), open = render(scene, {envmap}),
                kept = render(scene, {envmap, occlusion}),
                dimmed = render(scene, {envmap + ",occlusion=on", occlusion});
    EXPECT_EQ(open.data, kept.data);
    double all = 0, left = 0;
    for (std::size_t i = 0; i < open.data.size(); ++i)
        all += double(open.data[i] - direct.data[i]), left += double(dimmed.data[i] - direct.data[i]);
    EXPECT_LT(left, 0.95 * all);
    EXPECT_GT(left, 0.3 * all);
}

} // namespace
} // namespace luxel
