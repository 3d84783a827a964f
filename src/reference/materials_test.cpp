// SPDX-License-Identifier: MIT
// Coverage, absorption and clear coats against answers known on paper.
#include <gtest/gtest.h>

#include "reference/media.h"
#include "reference/test_scenes.h"
#include "scene/load.h"
#include "shared/clearcoat.h"
#include "support/data.h"

namespace luxel {
namespace {

using namespace testing;

Measured seen(const Scene& scene, const ReferenceRequest& request, const char* component = "full",
              int channel = 0) {
    RayCaster rays(scene);
    return measure(render_reference(rays, request), component, channel);
}

Material film(float alpha, glm::vec3 emission = glm::vec3(0.0f)) {
    Material m = lambertian(glm::vec3(0.0f), emission);
    m.base_color.a = alpha;
    m.alpha_mode = AlphaMode::blend;
    m.double_sided = true;
    return m;
}

void expect_mean(const Measured& m, double expected, double narrow = 0.01) {
    EXPECT_NEAR(m.mean, expected, z_999 * m.error + 1e-5);
    EXPECT_LT(z_999 * m.error, narrow * std::max(expected, 0.1)) << "the interval is narrow";
}

// Films of alpha a, b before a board of 1: what is seen of it is (1 - a)(1 - b), from the camera and by a
// lamp's light.
TEST(Coverage, FilmsLetTheRestThrough) {
    for (bool pixel_center : {false, true}) {
        Scene scene;
        add_object(scene, lambertian(glm::vec3(0), glm::vec3(1)), {-9, -9, -1}, {18, 0, 0}, {0, 18, 0});
        add_object(scene, film(0.3f), {-2, -2, 0}, {4, 0, 0}, {0, 4, 0});
        auto request = request_for({"full", "direct"}, camera_on({0, 0, 3}, {0, 0, 0}, 0.3f), 32, 256);
        request.settings.pixel_center = pixel_center;
        expect_mean(seen(scene, request), 0.7);
        expect_mean(seen(scene, request, "direct"), 0.7);
        add_object(scene, film(0.6f, glm::vec3(2)), {-2, -2, 1}, {4, 0, 0}, {0, 4, 0});
        expect_mean(seen(scene, request), 0.6 * 2.0 + 0.4 * 0.7);
    }
}

TEST(Coverage, FilmsOccludeTheirShare) {
    Scene scene;
    add_floor(scene, lambertian(glm::vec3(0.5f)));
    add_object(scene, film(0.25f), {-50, 0.4f, -50}, {100, 0, 0}, {0, 0, 100});
    // A ceiling at .4 of the radius leaves .16 open; a quarter of it the rest in proportion.
    expect_mean(seen(scene, request_for({"ao"}, camera_on({2, 0.2f, 0}, {0, 0, 0}), 16, 256), "ao"),
                1.0 - 0.25 * (1.0 - 0.16), 0.02);
}

// Through a film of coverage .3 come .7 of a lamp's, an emitter's and the sky's light, whichever finds it.
TEST(Coverage, FilmsShadowTheirShare) {
    for (int light = 0; light < 3; ++light) {
        const auto lit = [&](bool with_film) {
            Scene scene;
            add_floor(scene, lambertian(glm::vec3(0.8f)), 1.0f);
            if (light == 0) {
                shared::Light lamp{};
                lamp.type = shared::LIGHT_POINT;
                lamp.position = {0.2f, 3, 0};
                lamp.intensity = glm::vec3(5);
                scene.lights = {lamp};
            }
            if (light == 1)
                add_object(scene, lambertian(glm::vec3(0), glm::vec3(4)), {-0.5f, 3, -0.5f}, {1, 0, 0},
                           {0, 0, 1});
            if (light == 2) set_uniform_environment(scene, glm::vec3(1));
            if (with_film) add_object(scene, film(0.3f), {-500, 1, -500}, {1000, 0, 0}, {0, 0, 1000});
            return seen(scene, request_for({"direct"}, camera_on({0.2f, 0.8f, 0.1f}, {0, 0, 0}), 16, 256),
                        "direct");
        };
        const Measured open = lit(false), covered = lit(true);
        EXPECT_NEAR(covered.mean, 0.7 * open.mean, z_999 * std::hypot(covered.error, open.error) + 1e-5)
            << light;
        EXPECT_LT(covered.error, 0.005 * covered.mean) << light;
    }
}

// An emitter that is itself blended sends its coverage, by light samples and by paths that meet it.
TEST(Coverage, BlendedEmittersShineByTheirShare) {
    const auto lit = [&](float alpha) {
        Scene scene;
        add_floor(scene, lambertian(glm::vec3(0.8f)), 1.0f);
        add_object(scene, film(alpha, glm::vec3(4)), {-0.5f, 0.7f, -0.5f}, {1, 0, 0}, {0, 0, 1});
        return seen(scene, request_for({"direct"}, camera_on({0.8f, 0.4f, 0.1f}, {0, 0, 0}), 16, 256),
                    "direct");
    };
    const Measured whole = lit(1.0f), part = lit(0.4f);
    EXPECT_NEAR(part.mean, 0.4 * whole.mean, z_999 * std::hypot(part.error, whole.error));
    EXPECT_LT(part.error, 0.01 * part.mean);
}

TEST(Coverage, NothingAndAllAreExact) {
    for (float alpha : {0.0f, 1.0f}) {
        Scene scene;
        add_object(scene, lambertian(glm::vec3(0), glm::vec3(1)), {-9, -9, -1}, {18, 0, 0}, {0, 18, 0});
        add_object(scene, film(alpha), {-2, -2, 0}, {4, 0, 0}, {0, 4, 0});
        const Measured m = seen(scene, request_for({"full"}, camera_on({0, 0, 3}, {0, 0, 0}, 0.3f), 4, 4));
        EXPECT_EQ(m.mean, 1.0 - double(alpha));
    }
}

Material colored_block(glm::vec3 color, float distance) {
    Material m = solid_glass(1.0f);
    m.specular = 0.0f;
    m.attenuation_color = color, m.attenuation_distance = distance;
    return m;
}

void add_block(Scene& scene, const Material& material, glm::vec3 least, glm::vec3 most) {
    Mesh& mesh = add_mesh(scene, material);
    const glm::vec3 d = most - least;
    const glm::vec3 x(d.x, 0, 0), y(0, d.y, 0), z(0, 0, d.z);
    add_quad(mesh, least + z, x, y), add_quad(mesh, least, y, x);
    add_quad(mesh, least + x, y, z), add_quad(mesh, least, z, y);
    add_quad(mesh, least + y, z, x), add_quad(mesh, least, x, z);
}

// White light through d meters is color^(d / distance), from outside, from inside, and through a block in a
// block.
TEST(Absorption, FollowsBeersLaw) {
    const glm::vec3 color(0.1f, 0.5f, 0.9f);
    for (float far_eye : {1.0f, 0.0f}) {
        Scene scene;
        set_uniform_environment(scene, glm::vec3(1.0f));
        add_block(scene, colored_block(color, 1.0f), {-1, -1, -0.5f}, {1, 1, 0.5f});
        const auto request =
            request_for({"full"}, camera_on({0.01f, 0.02f, far_eye * 4}, {0.01f, 0.02f, -9}), 4, 4);
        const float way = far_eye > 0.0f ? 1.0f : 0.5f;
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(seen(scene, request, "full", c).mean, std::pow(color[c], way), 1e-3) << c;
        // The inner block's half meter is the inner material's.
        add_block(scene, colored_block(glm::vec3(0.25f), 1.0f), {-1, -1, -0.25f}, {1, 1, 0.25f});
        if (far_eye <= 0.0f) continue;
        EXPECT_NEAR(seen(scene, request, "full", 1).mean, std::pow(0.5f, 0.5f) * std::pow(0.25f, 0.5f), 1e-3);
    }
}

TEST(Absorption, ReachesWhatIsInside) {
    // A black board with light of its own in the middle of the block: seen through half of it.
    Scene scene;
    add_block(scene, colored_block(glm::vec3(0.1f, 0.5f, 0.9f), 1.0f), {-1, -1, -0.5f}, {1, 1, 0.5f});
    add_object(scene, lambertian(glm::vec3(0), glm::vec3(1)), {-0.4f, -0.4f, 0}, {0.8f, 0, 0}, {0, 0.8f, 0});
    const auto request = request_for({"full"}, camera_on({0, 0.01f, 4}, {0, 0.01f, 0}), 4, 4);
    EXPECT_NEAR(seen(scene, request).mean, std::sqrt(0.1), 1e-3);
}

// A smooth coat over black reflects 4 % from the front, and lets 96 % of what is below show.
TEST(Clearcoat, FollowsItsClosedFormFromTheFront) {
    const shared::Coat coat = shared::make_coat(0.5f, 0.0f, 1.0f, 1.0f);
    EXPECT_NEAR(coat.passes, 1.0f - 0.5f * 0.04f, 1e-4f);
    EXPECT_NEAR(coat.lobe.f0.x, 0.02f, 1e-4f);
    Scene scene;
    Material black = lambertian(glm::vec3(0));
    black.clearcoat = 1.0f;
    add_floor(scene, black);
    set_uniform_environment(scene, glm::vec3(1.0f));
    const auto request = request_for({"full"}, camera_on({0, 3, 0.01f}, {0, 0, 0}), 8, 128);
    expect_mean(seen(scene, request), 0.04, 0.1);
    scene.materials[0].base_color = glm::vec4(0.5f, 0.5f, 0.5f, 1.0f);
    expect_mean(seen(scene, request), 0.04 + 0.96 * 0.5, 0.02);
}

TEST(Clearcoat, WhiteStaysWhite) {
    for (float metallic : {0.0f, 1.0f})
        for (float roughness : {0.0f, 0.3f, 1.0f})
            for (float height : {0.2f, 2.0f}) {
                Scene scene;
                Material m;
                m.metallic = metallic, m.roughness = 0.4f;
                m.clearcoat = 0.8f, m.clearcoat_roughness = roughness;
                add_floor(scene, m);
                set_uniform_environment(scene, glm::vec3(1.0f));
                const Measured full =
                    seen(scene, request_for({"full"}, camera_on({1, height, 0}, {0, 0, 0}), 8, 256));
                EXPECT_NEAR(full.mean, 1.0, 0.006 + z_999 * full.error) << roughness << " " << height;
                EXPECT_LT(full.error, 0.006);
            }
}

TEST(Reports, BlendedFilmAndAbsorbingBlock) {
    LUXEL_DATA_OR_SKIP(film_file, "reports/12-blend-coverage/film_30.gltf");
    LUXEL_DATA_OR_SKIP(block_file, "reports/13-volume-absorption/absorbing_1m.gltf");
    const Scene with_film = load_scene(film_file.string()), with_block = load_scene(block_file.string());
    expect_mean(seen(with_film, request_for({"full"}, with_film.cameras[0], 16, 512)), 0.7, 0.02);
    RayCaster rays(with_block);
    const Estimate e = render_reference(rays, request_for({"full"}, with_block.cameras[0], 16, 64));
    const glm::vec3 left = e.mean.at("full").rgb(8, 8);
    EXPECT_NEAR(left.r, 0.1f, 1e-3f);
    EXPECT_NEAR(left.g, 0.5f, 1e-3f);
    EXPECT_NEAR(left.b, 0.9f, 1e-3f);
}

} // namespace
} // namespace luxel
