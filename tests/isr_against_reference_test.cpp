// SPDX-License-Identifier: MIT
// Image-space radiosity held against the path tracer: equal where everything is visible, closer than direct
// light elsewhere.
#include <gtest/gtest.h>

#include "scene/procedural.h"
#include "support/reference_pictures.h"

namespace luxel {
namespace {

using namespace testing;

Pictures render(const Scene& scene, int size, int spp, const std::string& technique,
                const std::string& component = "diffuse1") {
    const PictureSetup setup = {.width = size,
                                .height = size,
                                .spp = spp,
                                .environment = FrameOptions{}.environment,
                                .components = {"direct", component}};
    return render_pictures(scene, setup, technique);
}

// Three perpendicular quads seen along their diagonal under a point light: nothing is hidden, nothing leaves
// the image but the far ends of the quads.
Scene corner() {
    Scene s;
    s.name = "corner";
    glm::vec3 colors[3] = {{0.8f, 0.8f, 0.8f}, {0.8f, 0.2f, 0.2f}, {0.2f, 0.2f, 0.8f}};
    glm::vec3 axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (int i = 0; i < 3; ++i) {
        Material m;
        m.base_color = glm::vec4(colors[i], 1), m.metallic = 0, m.specular = 0, m.double_sided = true;
        s.materials.push_back(m);
        Mesh mesh;
        add_quad(mesh, glm::vec3(0), axes[(i + 1) % 3], axes[(i + 2) % 3]);
        mesh.material = i;
        s.meshes.push_back(mesh);
        s.instances.push_back({.name = "quad", .mesh = i});
    }
    shared::Light light{};
    light.type = shared::LIGHT_POINT, light.position = {0.6f, 0.7f, 0.8f}, light.intensity = glm::vec3(1);
    s.lights.push_back(light);
    Camera c;
    c.position = {2.2f, 2.2f, 2.2f}, c.forward = glm::normalize(glm::vec3(-1)), c.yfov = 0.6f;
    s.cameras.push_back(c);
    return s;
}

TEST(IsrAgainstReference, EqualsOneDiffuseBounceWhereAllIsVisible) {
    Scene scene = corner();
    expect_one_diffuse_bounce(render(scene, 192, 512, "isr:samples=256,radius=2,resolution=full"));
}

TEST(IsrAgainstReference, IsCloserThanDirectLight) {
    for (const Scene& scene : {cornell(), shapes(ShapesLight::point), sphere_in_box()})
        EXPECT_GT(gain_of(render(scene, 160, 256, "isr")), 0.0) << scene.name;
}

// Mean absolute error of the radiance that a technique adds, relative to the mean of what it should add; over
// blocks of 4x4 pixels, to leave less of the reference's noise in it.
double bounce_error(const Scene& scene, const std::string& technique, const std::string& component) {
    constexpr int size = 96, block = 4;
    Pictures p = render(scene, size, 256, technique, component);
    const Image& mean = p.reference.mean.at(component);
    double error = 0, truth = 0;
    for (int y = 0; y < size; y += block)
        for (int x = 0; x < size; x += block) {
            double found = 0, expected = 0;
            for (int i = 0; i < block * block; ++i) {
                int u = x + i % block, v = y + i / block;
                if (*p.mask.at(u, v) <= 0 || *p.reference.mask.at(u, v) <= 0) continue;
                found += double(luminance(p.image.rgb(u, v) - p.direct.rgb(u, v)));
                expected += double(luminance(mean.rgb(u, v)));
            }
            error += std::abs(found - expected), truth += expected;
        }
    return error / truth;
}

void add_quad_of(Scene& scene, glm::vec3 albedo, glm::vec3 corner, glm::vec3 edge_u, glm::vec3 edge_v) {
    Material m;
    m.base_color = glm::vec4(albedo, 1), m.metallic = 0, m.specular = 0;
    scene.materials.push_back(m);
    Mesh mesh;
    add_quad(mesh, corner, edge_u, edge_v);
    mesh.material = int(scene.meshes.size());
    scene.meshes.push_back(mesh);
    scene.instances.push_back({.name = "quad", .mesh = mesh.material});
}

void add_light(Scene& scene, glm::vec3 position, glm::vec3 direction, float half_angle) {
    shared::Light light{};
    light.type = shared::LIGHT_SPOT, light.position = position, light.direction = direction;
    light.intensity = glm::vec3(10);
    light.outer = shared::versine(half_angle), light.inner = shared::versine(half_angle * 0.9f);
    scene.lights.push_back(light);
}

// A floor and a wall at z = -2 before a camera at z = 2. Neither is lit.
Scene dark_stage() {
    Scene s;
    s.name = "stage";
    add_quad_of(s, glm::vec3(0.7f), {-3, 0, 3}, {6, 0, 0}, {0, 0, -5});
    add_quad_of(s, glm::vec3(0.7f), {-3, 0, -2}, {6, 0, 0}, {0, 3, 0});
    Camera c;
    c.position = {0, 1, 2}, c.yfov = 0.9f;
    s.cameras.push_back(c);
    return s;
}

TEST(IsrAgainstReference, CamerasFindTheSenderBehind) {
    // The eye stands before a lit wall at z = 3.
    Scene s = dark_stage();
    add_quad_of(s, {0.8f, 0.4f, 0.2f}, {2, 0, 3}, {-4, 0, 0}, {0, 2.5f, 0});
    add_light(s, {0, 1.5f, 1}, {0, 0, 1}, 0.6f);
    double without = bounce_error(s, "isr:radius=2", "diffuse1");
    double with = bounce_error(s, "isr:radius=2,cameras=5", "diffuse1");
    EXPECT_GT(without, 0.9);
    EXPECT_LT(with, 0.2 * without);
}

TEST(IsrAgainstReference, BorderFindsTheSenderBesideTheFrame) {
    // A lit wall at x = 2.1, of which the frame ends 0.1 m before.
    Scene s = dark_stage();
    add_quad_of(s, {0.8f, 0.4f, 0.2f}, {2.1f, 0, -2}, {0, 0, 2}, {0, 2, 0});
    add_light(s, {0.8f, 1, -1}, {1, 0, 0}, 0.6f);
    double without = bounce_error(s, "isr:radius=2", "diffuse1");
    double with = bounce_error(s, "isr:radius=2,border=0.5", "diffuse1");
    EXPECT_GT(without, 0.9);
    EXPECT_LT(with, 0.2 * without);
}

TEST(IsrAgainstReference, SecondLayerFindsTheSenderBehindAPlate) {
    // A plate hides a lit panel, whose light falls on the floor through it: held against the bounce without
    // visibility, which is what the estimate is.
    Scene s = dark_stage();
    add_quad_of(s, {0.8f, 0.4f, 0.2f}, {-0.5f, 0.5f, -1}, {1, 0, 0}, {0, 1, 0});
    add_quad_of(s, glm::vec3(0), {-0.5f, 0.45f, -0.5f}, {1, 0, 0}, {0, 1.1f, 0});
    add_light(s, {0, 1, -0.55f}, {0, 0, -1}, 0.6f);
    double without = bounce_error(s, "isr:radius=2", "diffuse1_unoccluded");
    double with = bounce_error(s, "isr:radius=2,layers=2", "diffuse1_unoccluded");
    EXPECT_GT(without, 0.9);
    EXPECT_LT(with, 0.2 * without);
}

TEST(IsrAgainstReference, BouncesApproachAllDiffuseLight) {
    Scene scene = cornell();
    double previous = 1e30;
    for (const char* bounces : {"1", "3"}) {
        double error = bounce_error(scene, std::string("isr:layers=2,bounces=") + bounces, "diffuse");
        EXPECT_LT(error, previous) << bounces;
        previous = error;
    }
}

} // namespace
} // namespace luxel
