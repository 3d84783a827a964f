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
bool reaches(const RayCaster& rays, const shared::Light& light, glm::vec3 point, glm::vec3 n, float lift) {
    shared::LightSample to_light = shared::sample_light(light, point);
    if (glm::dot(n, to_light.wi) <= 0.0f) return false;
    Ray ray{point + n * lift, to_light.wi, 0.0f, to_light.distance * 0.9999f};
    return !rays.occluded(ray);
}

// Where a receiver lies beside a shadow's border: moving it on its tangent plane by up to two of the map's
// texels, on a 5x5 grid, changes whether the light reaches it. (The nearest texel is up to .71 away, the
// receiver's offset adds up to .71, and the border itself is drawn to one texel.)
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

    bool lit = reaches(rays, light, point, n, lift);
    for (int y = -2; y <= 2; ++y)
        for (int x = -2; x <= 2; ++x) {
            glm::vec3 aside = view.right * (float(x) * 2.0f * view.half_texel.x * w) +
                              view.up * (float(y) * 2.0f * view.half_texel.y * w);
            glm::vec3 moved = point + aside - along * (glm::dot(aside, n) / cosine);
            if (reaches(rays, light, moved, n, lift) != lit) return true;
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
