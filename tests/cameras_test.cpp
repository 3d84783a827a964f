// SPDX-License-Identifier: MIT
// What cameras see, in the reference and in the frame alike: far away, in parallel projection, through the
// backs of single-sided surfaces, and in scenes far from their origin.
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "core/error.h"
#include "reference/reference.h"
#include "scene/load.h"
#include "scene/procedural.h"
#include "scene/procedural_parts.h"
#include "scene/raycast.h"
#include "support/data.h"
#include "techniques/frame/renderer.h"
#include "techniques/technique.h"

namespace luxel {
namespace {

using namespace procedural;

struct Size {
    int width, height;
};

// The component by the reference; the image of the frame with the technique, or with direct light alone.
Image traced(const Scene& scene, const Camera& camera, Size size, const std::string& component = "direct",
             int spp = 4) {
    const RayCaster rays(scene);
    ReferenceRequest request{
        .components = {component}, .width = size.width, .height = size.height, .camera = camera};
    request.settings.spp = spp;
    request.settings.pixel_center = true;
    return render_reference(rays, request).mean.at(component);
}

Image drawn(const Scene& scene, const Camera& camera, Size size, const std::string& technique = "") {
    gpu::Gpu gpu({.validation = true});
    FrameOptions options;
    options.shadow = ShadowMode::hard;
    Renderer renderer(gpu, scene, options);
    RenderRequest request{.camera = camera, .width = size.width, .height = size.height};
    const auto made = technique.empty() ? nullptr : make_technique({technique, {}});
    if (made) request.techniques = {made.get()};
    const Image image = renderer.render(request).radiance;
    for (const std::string& message : gpu.validation_messages()) ADD_FAILURE() << message;
    return image;
}

// A board that glows with radiance 1, from (-.5, -.5) to (.5, .5) at a distance, seen along -z.
Scene board(float distance, float side = 1.0f) {
    Scene scene;
    const float h = 0.5f * side;
    add_quad_object(scene, lambertian("board", glm::vec3(0.0f), glm::vec3(1.0f)), {-h, -h, -distance},
                    {side, 0, 0}, {0, side, 0});
    return scene;
}

Camera parallel(float half_height) {
    Camera camera;
    camera.near = 0.0f;
    camera.half_height = half_height;
    return camera;
}

float middle(const Image& image) { return image.rgb(image.width / 2, image.height / 2).r; }

// Both answers at the middle of the image.
void expect_middle(const Scene& scene, const Camera& camera, float radiance, const char* what) {
    EXPECT_NEAR(middle(traced(scene, camera, {9, 9})), radiance, 1e-5f) << what;
    EXPECT_NEAR(middle(drawn(scene, camera, {9, 9})), radiance, 1e-5f) << what;
}

TEST(Cameras, SeeToInfinityUnlessToldOtherwise) {
    Camera camera;
    for (const float distance : {1.5f, 1500.0f, 1.5e6f}) {
        camera.far = std::numeric_limits<float>::infinity();
        expect_middle(board(distance, distance), camera, 1.0f, "infinite");
        camera.far = 0.9f * distance;
        expect_middle(board(distance, distance), camera, 0.0f, "too near");
        camera.far = 1.1f * distance;
        expect_middle(board(distance, distance), camera, 1.0f, "far enough");
    }
}

// Columns and rows of an image of 16 x 8 pixels, 2 m high, that the board covers: pixels 6 to 9 and 2 to 5.
void expect_board(const Image& image, const char* what) {
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 16; ++x)
            ASSERT_EQ(image.rgb(x, y).r, x >= 6 && x < 10 && y >= 2 && y < 6 ? 1.0f : 0.0f)
                << what << " " << x << " " << y;
}

TEST(Cameras, ParallelProjectionKeepsSizes) {
    for (const float distance : {1.0f, 4000.0f}) {
        expect_board(traced(board(distance), parallel(1.0f), {16, 8}), "reference");
        expect_board(drawn(board(distance), parallel(1.0f), {16, 8}), "frame");
    }
    Camera cut = parallel(1.0f);
    cut.near = 3.0f, cut.far = 5.0f;
    for (const float distance : {2.9f, 3.1f, 4.9f, 5.1f})
        expect_middle(board(distance), cut, distance > 3.0f && distance < 5.0f ? 1.0f : 0.0f, "cut");
}

// A perspective camera so far away that its rays are all but parallel.
Camera from_afar(const Camera& camera, float distance) {
    const float back = 1000.0f * camera.half_height;
    Camera far = camera;
    far.half_height = 0.0f;
    far.position -= camera.forward * back;
    far.yfov = 2.0f * std::atan(camera.half_height / (back + distance));
    far.near = back + camera.near;
    return far;
}

double relative_difference(const Image& a, const Image& b) {
    double difference = 0.0, sum = 0.0;
    for (std::size_t i = 0; i < a.data.size(); ++i)
        difference += std::abs(double(a.data[i]) - double(b.data[i])), sum += double(b.data[i]);
    EXPECT_GT(sum, 0.0);
    return difference / sum;
}

struct Parallel {
    const char* technique;
    const char* scene;
    glm::vec3 position, target;
    float half_height;
};

// Edges of objects and shadows move by hundredths of a pixel, and rounding at 1000 half heights by as much:
// two per cent, and twice that of a relief, whose search along a ray from 800 m away starts from a position
// that is rounded to .06 mm; a technique that takes the rays for those of a pinhole is off by a tenth and
// more.
TEST(Cameras, TechniquesTakeParallelViews) {
    for (const Parallel& c :
         {Parallel{"", "builtin:shapes-point", {3, 4, 5}, {0, 0.5f, 0}, 1.5f},
          Parallel{"vpl", "builtin:shapes-point", {3, 4, 5}, {0, 0.5f, 0}, 1.5f},
          Parallel{"relief", "builtin:relief", {1, 2, 3}, {0, 0.5f, 0}, 0.8f},
          Parallel{"distance_map", "builtin:mirror-box", {0.3f, 0.2f, 0.9f}, {0, 0, 0}, 0.5f},
          Parallel{"caustic_triangles", "builtin:metal-ring", {1, 2, 3}, {0, 0, 0}, 0.8f}}) {
        const Scene scene = load_scene(c.scene);
        Camera camera = parallel(c.half_height);
        camera.position = c.position;
        camera.forward = glm::normalize(c.target - c.position);
        const float distance = glm::length(c.target - c.position);
        const Size size{96, 64};
        EXPECT_LT(relative_difference(drawn(scene, camera, size, c.technique),
                                      drawn(scene, from_afar(camera, distance), size, c.technique)),
                  std::string_view(c.technique) == "relief" ? 0.04 : 0.02)
            << c.scene << " " << c.technique;
        if (*c.technique) continue;
        EXPECT_LT(relative_difference(traced(scene, camera, size),
                                      traced(scene, from_afar(camera, distance), size)),
                  0.01);
        EXPECT_LT(relative_difference(drawn(scene, camera, size), traced(scene, camera, size)), 0.02);
    }
}

// The radius of photons is a share of a pixel, which does not grow with the distance here.
TEST(Cameras, CausticsOfParallelViews) {
    const Scene scene = load_scene("builtin:metal-ring");
    Camera camera = parallel(0.6f);
    camera.position = {0, 3, 0.01f}, camera.forward = {0, -1, 0}, camera.up = {0, 0, -1};
    const Size size{24, 24};
    const Image near = traced(scene, camera, size, "caustics", 16);
    const Image far = traced(scene, from_afar(camera, 3.0f), size, "caustics", 16);
    EXPECT_LT(relative_difference(near, far), 0.02);
}

TEST(Cameras, TechniquesThatCannotTakeParallelViewsSaySo) {
    const Scene scene = cornell();
    gpu::Gpu gpu({.validation = true});
    Renderer renderer(gpu, scene, {});
    for (const char* name : {"isr", "gtao", "ssao", "ssdo", "photon_map"}) {
        const auto technique = make_technique({name, {}});
        Camera camera = parallel(1.0f);
        camera.name = "plan";
        try {
            renderer.render({.camera = camera, .width = 8, .height = 8, .techniques = {technique.get()}});
            ADD_FAILURE() << name;
        } catch (const Error& error) {
            EXPECT_EQ(error.fault(), Fault::usage);
            EXPECT_NE(std::string(error.what()).find("\"plan\" is orthographic"), std::string::npos)
                << error.what();
        }
    }
}

// The board behind a black wall whose back is turned to the camera.
Scene behind(Material wall) {
    Scene scene = board(4.0f, 4.0f);
    wall.backs_unseen = !wall.double_sided;
    add_quad_object(scene, wall, {-9, -9, -2}, {0, 18, 0}, {18, 0, 0});
    return scene;
}

TEST(Cameras, LookThroughTheBacksOfSingleSidedSurfaces) {
    const Material single = lambertian("wall", glm::vec3(0.0f));
    Scene scene = behind(single);
    const Camera camera;
    expect_middle(scene, camera, 1.0f, "back");
    expect_middle(scene, parallel(1.0f), 1.0f, "back, parallel");
    scene.materials[1].backs_unseen = false;
    expect_middle(scene, camera, 0.0f, "opaque");
    Material both = single;
    both.double_sided = true;
    expect_middle(behind(both), camera, 0.0f, "double-sided");

    // Mirrored, its front is toward the camera all the same; turned about, it is.
    scene = behind(single);
    scene.instances[1].transform[0][0] = -1.0f;
    expect_middle(scene, camera, 1.0f, "mirrored");
    scene = behind(single);
    std::swap(scene.meshes[1].indices[1], scene.meshes[1].indices[2]);
    std::swap(scene.meshes[1].indices[4], scene.meshes[1].indices[5]);
    expect_middle(scene, camera, 0.0f, "front");
    scene.instances[1].transform[0][0] = -1.0f;
    expect_middle(scene, camera, 0.0f, "mirrored front");

    // Back to back in one plane: the front is seen, whichever of the two a ray finds first.
    scene = behind(single);
    Material paint = lambertian("paint", glm::vec3(0.0f), glm::vec3(0.25f));
    paint.backs_unseen = true;
    add_quad_object(scene, paint, {-9, -9, -2}, {18, 0, 0}, {0, 18, 0});
    expect_middle(scene, camera, 0.25f, "back to back");

    // Masked, and the boundary of a solid, through whose back an eye inside looks out.
    Material masked = single;
    masked.alpha_mode = AlphaMode::mask;
    expect_middle(behind(masked), camera, 1.0f, "masked");
    Material solid = glass("water", 1.33f);
    solid.thin = false;
    EXPECT_FALSE(behind(solid).materials[1].looks_through_back());
}

// Light stays out where the eye looks in: a closed room is dark inside for a lamp outside.
TEST(Cameras, LightDoesNotPassTheBacks) {
    Scene scene;
    Material wall = lambertian("wall", glm::vec3(0.5f));
    wall.backs_unseen = true;
    add_quad_object(scene, wall, {-9, -9, -4}, {18, 0, 0}, {0, 18, 0});
    add_quad_object(scene, wall, {-9, -9, -2}, {0, 18, 0}, {18, 0, 0});
    scene.lights.push_back(point_light({0, 0, 0}, 100.0f));
    expect_middle(scene, Camera{}, 0.0f, "lamp outside");
    scene.lights[0].position.z = -3.0f;
    expect_middle(scene, Camera{}, 100.0f * 0.5f / 3.14159265f, "lamp inside");
}

// Reports of others, where they are: one place at the origin and with coordinates of a national grid.
TEST(Cameras, ScenesFarFromTheirOriginLookTheSame) {
    LUXEL_DATA_OR_SKIP(here, "reports/09-far-from-origin/at_origin.gltf");
    const Scene near = load_scene(here.string());
    const Scene far = load_scene((here.parent_path() / "at_utm.gltf").string());
    const Size size{64, 64};
    EXPECT_LT(relative_difference(traced(far, far.cameras[0], size), traced(near, near.cameras[0], size)),
              0.002);
    EXPECT_LT(relative_difference(drawn(far, far.cameras[0], size), drawn(near, near.cameras[0], size)),
              0.002);
}

} // namespace
} // namespace luxel
