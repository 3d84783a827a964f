// SPDX-License-Identifier: MIT
// Image-space radiosity held against the path tracer: equal where everything is visible, closer than direct
// light elsewhere.
#include <gtest/gtest.h>

#include "core/metrics.h"
#include "reference/reference.h"
#include "scene/procedural.h"
#include "techniques/frame/renderer.h"

namespace luxel {
namespace {

struct Pictures {
    Image direct, isr, mask;
    Estimate reference;
};

Pictures render(const Scene& scene, int size, int spp, const std::string& technique) {
    gpu::Gpu gpu({.validation = true});
    FrameOptions options;
    options.shadow = ShadowMode::hard;
    Renderer renderer(gpu, scene, options);
    std::unique_ptr<Technique> isr = make_technique(parse_specification(technique));
    RenderRequest request{.camera = scene.cameras.front(), .width = size, .height = size};
    Pictures p;
    p.direct = renderer.render(request).radiance;
    request.techniques = {isr.get()};
    RenderResult result = renderer.render(request);
    p.isr = result.radiance, p.mask = result.mask;
    EXPECT_TRUE(gpu.validation_messages().empty());
    RayCaster rays(scene);
    ReferenceRequest truth{
        .components = {"direct", "diffuse1"}, .width = size, .height = size, .camera = scene.cameras.front()};
    truth.settings.spp = spp;
    truth.settings.pixel_center = true;
    p.reference = render_reference(rays, truth);
    return p;
}

Image sum(const Image& a, const Image& b) {
    Image c = a;
    for (std::size_t i = 0; i < c.data.size(); ++i) c.data[i] += b.data[i];
    return c;
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
    Pictures p = render(scene, 192, 512, "isr:samples=256,radius=2,resolution=full");
    double bounce = 0, truth = 0, squares = 0, pixels = 0;
    const Image& diffuse1 = p.reference.mean.at("diffuse1");
    for (int y = 0; y < 192; ++y)
        for (int x = 0; x < 192; ++x) {
            if (*p.mask.at(x, y) <= 0 || *p.reference.mask.at(x, y) <= 0) continue;
            float b = luminance(p.isr.rgb(x, y) - p.direct.rgb(x, y)), t = luminance(diffuse1.rgb(x, y));
            bounce += b, truth += t, squares += double(b - t) * double(b - t), ++pixels;
        }
    EXPECT_NEAR(bounce / truth, 1.0, 0.02);
    EXPECT_LT(std::sqrt(squares / pixels) / (truth / pixels), 0.08);
}

TEST(IsrAgainstReference, IsCloserThanDirectLight) {
    for (const Scene& scene : {cornell(), shapes(ShapesLight::point), sphere_in_box()}) {
        Pictures p = render(scene, 160, 256, "isr");
        Image truth = sum(p.reference.mean.at("direct"), p.reference.mean.at("diffuse1"));
        float exposure = exposure_of(truth, p.reference.mask);
        Image shown = display(truth, exposure);
        double direct = mean_error(shown, display(p.direct, exposure), p.reference.mask);
        double with_isr = mean_error(shown, display(p.isr, exposure), p.reference.mask);
        EXPECT_GT(gain(direct, with_isr), 0.0) << scene.name;
    }
}

} // namespace
} // namespace luxel
