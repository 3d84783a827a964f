// SPDX-License-Identifier: MIT
// The frame's direct light against the path tracer's: same pixel centers, textures at full size, hard
// shadows.
#include <cmath>

#include <gtest/gtest.h>

#include "reference/reference.h"
#include "scene/lights.h"
#include "scene/load.h"
#include "scene/procedural.h"
#include "support/data.h"
#include "techniques/frame/projection.h"
#include "techniques/frame/renderer.h"
#include "techniques/frame/shadow_maps.h"

namespace luxel {
namespace {

struct Size {
    int width, height;
};

Image reference_direct(const RayCaster& rays, const Camera& camera, Size size, int spp) {
    ReferenceRequest request{
        .components = {"direct"}, .width = size.width, .height = size.height, .camera = camera};
    request.settings.spp = spp;
    request.settings.pixel_center = true;
    return render_reference(rays, request).mean.at("direct");
}

RenderResult frame_direct(const Scene& scene, const Camera& camera, Size size, const FrameOptions& options) {
    gpu::Gpu gpu({.validation = true});
    Renderer renderer(gpu, scene, options);
    RenderResult result =
        renderer.render({.camera = camera, .width = size.width, .height = size.height, .images = {"depth"}});
    for (const std::string& message : gpu.validation_messages()) ADD_FAILURE() << message;
    return result;
}

// Hard shadows, full-size textures, and no light but the scene's own.
FrameOptions exact_options() {
    FrameOptions options;
    options.shadow = ShadowMode::hard;
    options.emitter_lights = 0;
    options.environment = EnvironmentMode::none;
    options.mipmaps = false;
    return options;
}

// lift: meters off the surface where the ray starts.
float reaches(const RayCaster& rays, const shared::Light& light, glm::vec3 point, glm::vec3 n, float lift) {
    shared::LightSample to_light = shared::sample_light(light, point);
    if (glm::dot(n, to_light.wi) <= 0.0f) return 0.0f;
    Ray ray{point + n * lift, to_light.wi, 0.0f, to_light.distance * 0.9999f};
    return luminance(rays.transmitted(ray));
}

// Where a receiver lies beside a shadow's border: moving it on its tangent plane by up to two of the map's
// texels, on a 5x5 grid, changes whether the light reaches it, or through how many panes. (The nearest texel
// is up to .71 away, the receiver's offset adds up to .71, and the border itself is drawn to one texel.)
bool near_border(const RayCaster& rays, const FittedLight& fitted, glm::vec3 point, glm::vec3 n, float lift) {
    const shared::Light& light = fitted.light.light;
    std::size_t map = 0;
    if (fitted.views.size() > 1) map = shared::cube_face(fitted.light.axes, point - light.position);
    if (map >= fitted.views.size()) return false;
    const shared::ShadowView& view = fitted.views[map];
    float w = (view.world_to_map * glm::vec4(point, 1.0f)).w;
    glm::vec3 along = shared::sample_light(light, point).wi;
    float cosine = glm::dot(along, n);
    if (cosine <= 0.0f) return false;

    float lit = reaches(rays, light, point, n, lift);
    for (int y = -2; y <= 2; ++y)
        for (int x = -2; x <= 2; ++x) {
            glm::vec3 aside = view.right * (float(x) * 2.0f * view.half_texel.x * w) +
                              view.up * (float(y) * 2.0f * view.half_texel.y * w);
            glm::vec3 moved = point + aside - along * (glm::dot(aside, n) / cosine);
            if (std::abs(reaches(rays, light, moved, n, lift) - lit) > 0.02f) return true;
        }
    return false;
}

struct Comparison {
    double error = 0;    // mean of |x - r| / r over what is compared and lit
    double leaks = 0;    // share of what is compared and unlit where the frame has light
    double border = 0;   // share of surface pixels left out beside a shadow's border
    double mismatch = 0; // share left out because another surface is seen there
};

Comparison compare(const Scene& scene, const RayCaster& rays, const Camera& camera, Size size,
                   const FrameOptions& options) {
    Image reference = reference_direct(rays, camera, size, 1);
    RenderResult frame = frame_direct(scene, camera, size, options);
    CameraBasis basis = camera_basis(camera, size.width, size.height);
    shared::ViewParams view = view_params(camera, size.width, size.height);
    const Bounds bounds = scene.bounds();
    std::vector<glm::vec3> receivers = common_corners(bounds, frustum_of(view.world_to_clip), view.position);
    const float lift = 1e-5f * bounds.radius();
    std::vector<FittedLight> lights;
    for (const shared::Light& light : scene.lights)
        lights.push_back(
            fit_shadow_maps(light, scene.bounds(), receivers,
                            shadow_map_count(light) > 1 ? options.shadow_size / 2 : options.shadow_size));

    Comparison c;
    int surface = 0, lit = 0, unlit = 0;
    float bright = 1.0f / exposure_of(reference, frame.mask);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
            Ray ray{basis.position, pixel_direction(basis, size.width, size.height, glm::vec2(x, y) + 0.5f),
                    camera.near, camera.far};
            Hit hit;
            bool found = rays.intersect(ray, hit);
            surface += found;
            float z = *frame.images.at("depth").at(x, y);
            if (!found && z == 0.0f) continue;
            // On an edge the rasterizer's 1/256 pixel grid may choose the other surface.
            if (!found || std::abs(z - hit.t) > 1e-3f * hit.t) {
                c.mismatch += 1;
                continue;
            }
            glm::vec3 point = ray.origin + ray.direction * hit.t, n = glm::normalize(hit.geometric_normal);
            if (glm::dot(n, ray.direction) > 0.0f) n = -n;
            bool border = false;
            for (const FittedLight& light : lights)
                border = border || near_border(rays, light, point, n, lift);
            if (border) {
                c.border += 1;
                continue;
            }
            float r = luminance(reference.rgb(x, y)), v = luminance(frame.radiance.rgb(x, y));
            if (r > 1e-3f * bright)
                lit += 1, c.error += std::abs(v - r) / r;
            else
                unlit += 1, c.leaks += v > 1e-2f * bright;
        }
    c.error /= lit;
    c.leaks /= std::max(unlit, 1);
    c.border /= surface, c.mismatch /= surface;
    std::printf("%s: error %.3f %%, leaks %.3f %%, left out: %.2f %% at borders, %.3f %% at edges\n",
                scene.name.c_str(), 100 * c.error, 100 * c.leaks, 100 * c.border, 100 * c.mismatch);
    return c;
}

void expect_agreement(const Comparison& c) {
    EXPECT_LE(c.error, 0.01);
    EXPECT_LE(c.leaks, 0.001);
    EXPECT_LE(c.mismatch, 0.005);
    EXPECT_LE(c.border, 0.25); // or too little is compared
}

TEST(FrameAgainstReference, ShapesUnderPointSpotAndDirectionalLight) {
    for (ShapesLight light : {ShapesLight::point, ShapesLight::spot, ShapesLight::directional}) {
        Scene scene = shapes(light);
        RayCaster rays(scene);
        expect_agreement(compare(scene, rays, scene.cameras[0], {320, 240}, exact_options()));
    }
}

// Panes of colored glass above a floor, one above the other in part, one slanted, a solid card between, and
// one that only half of the light passes, whose own top the light has not passed yet.
Scene glazing(shared::uint type) {
    Scene scene;
    scene.name = "glazing";
    const auto add = [&](const Material& m, glm::vec3 corner, glm::vec3 u, glm::vec3 v) {
        scene.materials.push_back(m);
        Mesh mesh;
        mesh.material = int(scene.materials.size()) - 1;
        add_quad(mesh, corner, u, v);
        scene.meshes.push_back(mesh);
        scene.instances.push_back({.mesh = int(scene.meshes.size()) - 1});
    };
    Material gray, glass, half;
    gray.base_color = {0.6f, 0.5f, 0.4f, 1.0f}, gray.metallic = 0.0f;
    glass.base_color = {0.9f, 0.5f, 0.2f, 1.0f}, glass.metallic = glass.roughness = 0.0f,
    glass.transmission = 1.0f;
    half = gray, half.transmission = 0.5f, half.roughness = half.specular = 0.0f;
    add(gray, {-4, 0, 4}, {8, 0, 0}, {0, 0, -8});
    add(glass, {-2.5f, 1.0f, 2}, {3, 0, 0}, {0, 0, -3});
    glass.base_color = {0.3f, 0.8f, 0.9f, 1.0f}, glass.ior = 1.8f;
    add(glass, {-1.5f, 1.3f, 1.4f}, {3, 0.8f, 0}, {0, 0, -3});
    add(gray, {-0.4f, 0.6f, 0.4f}, {0.8f, 0, 0}, {0, 0, -0.8f});
    add(half, {2.0f, 0.4f, 3.9f}, {1.5f, 0, 0}, {0, 0, -1.5f}); // behind no other sheet
    shared::Light light{};
    light.type = type, light.position = {0.4f, 3.5f, 0.6f};
    light.direction = glm::normalize(glm::vec3(0.2f, -1.0f, -0.3f)), light.intensity = glm::vec3(10, 12, 14);
    light.inner = shared::versine(0.6f), light.outer = shared::versine(0.9f);
    scene.lights = {light};
    Camera camera;
    camera.position = {0.5f, 2.6f, 5.5f}, camera.forward = glm::normalize(glm::vec3(-0.05f, -0.5f, -1.0f));
    scene.cameras = {camera};
    return scene;
}

TEST(FrameAgainstReference, PanesWeakenPointSpotAndDirectionalLight) {
    for (shared::uint type :
         {shared::LIGHT_POINT, shared::LIGHT_SPOT, shared::LIGHT_DIRECTIONAL, shared::LIGHT_COSINE})
        for (ShadowMode mode : {ShadowMode::hard, ShadowMode::pcf}) {
            const Scene scene = glazing(type);
            const RayCaster rays(scene);
            FrameOptions options = exact_options();
            options.shadow = mode;
            const Comparison c = compare(scene, rays, scene.cameras[0], {320, 240}, options);
            EXPECT_LE(c.error, 0.01) << type << " " << int(mode);
            EXPECT_LE(c.border, 0.25) << type;
            EXPECT_LE(c.leaks, mode == ShadowMode::hard ? 0.001 : 0.02) << type;
        }
}

// The emitter replaced by three of its sample lights: the maths of a light, without the error of sampling.
TEST(FrameAgainstReference, CornellUnderCosineLights) {
    Scene scene = cornell();
    scene.lights = emitter_sample_lights(scene, 3, 1);
    for (Material& m : scene.materials) m.emission = glm::vec3(0.0f);
    RayCaster rays(scene);
    expect_agreement(compare(scene, rays, scene.cameras[0], {256, 256}, exact_options()));
}

// Normal maps, alpha masks, 262 thousand triangles, the sun. (Camera 1 sees no sunlight to speak of.)
TEST(FrameAgainstReference, Sponza) {
    LUXEL_DATA_OR_SKIP(file, "sponza_crytek/sponza_crytek.gltf");
    Scene scene = load_scene(file.string());
    RayCaster rays(scene);
    for (std::size_t i : {std::size_t(0), std::size_t(2)})
        expect_agreement(compare(scene, rays, scene.cameras.at(i), {320, 240}, exact_options()));
}

// Mean of |x - r| over the mean of r, over surface pixels.
double mean_relative_difference(const Image& reference, const RenderResult& frame) {
    double difference = 0, sum = 0;
    for (int y = 0; y < reference.height; ++y)
        for (int x = 0; x < reference.width; ++x) {
            if (*frame.mask.at(x, y) == 0.0f) continue;
            float r = luminance(reference.rgb(x, y));
            difference += std::abs(luminance(frame.radiance.rgb(x, y)) - r), sum += r;
        }
    return difference / sum;
}

// A lamp's highlight on polished plastic is the lamp's mirror image, not 32 dazzling dots: no pixel is far
// brighter than the image's brightest, and the light of the whole is that of the truth.
TEST(FrameAgainstReference, HighlightsOfSampledLampsAreAsBrightAsTheLamp) {
    Scene scene;
    scene.name = "highlight";
    const auto add = [&](const Material& m, glm::vec3 corner, glm::vec3 u, glm::vec3 v) {
        scene.materials.push_back(m);
        Mesh mesh;
        mesh.material = int(scene.materials.size()) - 1;
        add_quad(mesh, corner, u, v);
        scene.meshes.push_back(mesh);
        scene.instances.push_back({.mesh = int(scene.meshes.size()) - 1});
    };
    Material plastic, lamp;
    plastic.base_color = {0.02f, 0.02f, 0.02f, 1.0f}, plastic.metallic = 0.0f, plastic.roughness = 0.12f;
    lamp.base_color = {0, 0, 0, 1}, lamp.emission = glm::vec3(20.0f);
    add(plastic, {-4, 0, 4}, {8, 0, 0}, {0, 0, -8});
    add(lamp, {-0.5f, 2, -2.5f}, {1, 0, 0}, {0, 0, 1});
    Camera camera;
    camera.position = {0, 1.5f, 2.5f}, camera.forward = glm::normalize(glm::vec3(0, -0.7f, -1));
    const Size size{64, 48};
    const RayCaster rays(scene);
    const Image truth = reference_direct(rays, camera, size, 512);
    FrameOptions options = exact_options();
    options.shadow = ShadowMode::pcf, options.emitter_lights = 32;
    const RenderResult frame = frame_direct(scene, camera, size, options);
    double sum = 0, sum_truth = 0;
    float most = 0, most_truth = 0;
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
            if (*frame.mask.at(x, y) == 0.0f || truth.rgb(x, y).g > 15.0f) continue; // the lamp itself
            sum += double(frame.radiance.rgb(x, y).g), sum_truth += double(truth.rgb(x, y).g);
            most = std::max(most, frame.radiance.rgb(x, y).g),
            most_truth = std::max(most_truth, truth.rgb(x, y).g);
        }
    EXPECT_LT(most, 2.0f * most_truth);
    EXPECT_NEAR(sum / sum_truth, 1.0, 0.05);
}

TEST(FrameAgainstReference, EmitterSamplesConvergeToTheAreaLight) {
    Scene scene = cornell();
    RayCaster rays(scene);
    Size size{64, 64};
    Image reference = reference_direct(rays, scene.cameras[0], size, 4096);
    std::vector<double> errors;
    for (int count : {16, 64, 256}) {
        FrameOptions options = exact_options();
        options.shadow = ShadowMode::pcf;
        options.emitter_lights = count;
        errors.push_back(0.0);
        for (int seed : {1, 2}) {
            options.seed = seed;
            RenderResult frame = frame_direct(scene, scene.cameras[0], size, options);
            errors.back() += mean_relative_difference(reference, frame) / 2;
        }
        std::printf("%d emitter lights: error %.2f %%\n", count, 100 * errors.back());
    }
    EXPECT_LE(errors[1], 0.03);
    EXPECT_LT(errors[1], errors[0]);
    EXPECT_LT(errors[2], errors[1]);
}

} // namespace
} // namespace luxel
