// SPDX-License-Identifier: MIT
// Screen-space directional occlusion held against the path tracer: equal to one diffuse bounce where
// everything is visible and within the radius, closer than direct light elsewhere; ambient light of an
// environment is not counted twice.
#include <gtest/gtest.h>

#include "scene/lights.h"
#include "scene/load.h"
#include "scene/procedural.h"
#include "support/data.h"
#include "support/reference_pictures.h"

namespace luxel {
namespace {

using namespace testing;

Pictures render(const Scene& scene, PictureSetup setup, const std::string& use) {
    setup.emitter_lights = 16;
    return render_pictures(scene, setup, use);
}

// A floor and a wall under a point light: nothing is hidden but the far ends.
Scene floor_and_wall() {
    Scene s;
    for (int i = 0; i < 2; ++i) {
        Material m;
        m.base_color = glm::vec4(i ? 0.2f : 0.7f, 0.7f, 0.7f, 1), m.metallic = 0, m.specular = 0;
        s.materials.push_back(m);
        Mesh mesh;
        if (i == 0)
            add_quad(mesh, {-1, 0, 0}, {0, 0, 2}, {2, 0, 0});
        else
            add_quad(mesh, {-1, 0, 0}, {2, 0, 0}, {0, 2, 0});
        mesh.material = i;
        s.meshes.push_back(mesh);
        s.instances.push_back({.name = "quad", .mesh = i});
    }
    shared::Light light{};
    light.type = shared::LIGHT_POINT, light.position = {0.2f, 0.8f, 0.9f}, light.intensity = glm::vec3(1);
    s.lights.push_back(light);
    Camera c;
    c.position = {0, 3, 3}, c.forward = glm::normalize(glm::vec3(0, -0.8f, -0.8f)), c.yfov = 0.9f;
    s.cameras.push_back(c);
    return s;
}

TEST(SsdoAgainstReference, EqualsOneDiffuseBounceWhereAllIsVisible) {
    expect_one_diffuse_bounce(render(floor_and_wall(), {.spp = 512},
                                     "ssdo:samples=64,steps=24,radius=4,resolution=full,thickness=0"));
}

TEST(SsdoAgainstReference, IsCloserThanDirectLight) {
    // Half of what was measured when this was written is asked for: 74, 73 and 81 %.
    for (const Scene& scene : {cornell(), shapes(ShapesLight::point), sphere_in_box()})
        EXPECT_GT(gain_of(render(scene, {}, "ssdo")), 37.0) << scene.name;
}

TEST(SsdoAgainstReference, IsCloserThanDirectLightInSponza) {
    LUXEL_DATA_OR_SKIP(file, "sponza_crytek/sponza_crytek.gltf");
    Scene scene = load_scene(file.string());
    EXPECT_GT(gain_of(render(scene, {.width = 160, .height = 120, .spp = 64}, "ssdo")), 0.0);
}

// Under a sky alone the truth's `direct` is the sky as it is hidden.
TEST(SsdoAgainstReference, HidesTheSkyByDirection) {
    Scene scene = shapes(ShapesLight::point);
    scene.lights.clear();
    scene.environment = gradient_sky(glm::vec3(0.3f), {0.4f, 0.6f, 1.0f}, glm::vec3(0.1f));
    Pictures p = render(scene, {.spp = 256, .environment = EnvironmentMode::ambient}, "ssdo:radius=100");
    double without = 0, with = 0;
    for (int y = 0; y < p.mask.height; ++y)
        for (int x = 0; x < p.mask.width; ++x) {
            if (*p.mask.at(x, y) <= 0 || *p.reference.mask.at(x, y) <= 0) continue;
            float truth = luminance(p.reference.mean.at("direct").rgb(x, y));
            without += double(std::abs(luminance(p.direct.rgb(x, y)) - truth));
            with += double(std::abs(luminance(p.image.rgb(x, y)) - truth));
        }
    EXPECT_LT(with, 0.5 * without);
}

} // namespace
} // namespace luxel
