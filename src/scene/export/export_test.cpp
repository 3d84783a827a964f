// SPDX-License-Identifier: MIT
// What other renderers are told, held against their own documented conventions, written out once more here.
#include <gtest/gtest.h>

#include <random>
#include <sstream>

#include "core/file.h"
#include "core/image_io.h"
#include "scene/environment.h"
#include "scene/export/mitsuba/mitsuba.h"
#include "scene/export/pbrt/pbrt.h"
#include "scene/export/sky.h"
#include "scene/load.h"
#include "support/temporary_folder.h"

namespace luxel {
namespace {

using testing::TemporaryFolder;

std::string text_of(const std::filesystem::path& file) {
    const std::vector<std::uint8_t> bytes = read_file(file);
    return {bytes.begin(), bytes.end()};
}

// The numbers behind `mark` and what separates them.
std::vector<float> numbers_after(const std::string& text, const std::string& mark, std::size_t count) {
    const std::size_t place = text.find(mark);
    EXPECT_NE(place, std::string::npos) << mark;
    if (place == std::string::npos) return std::vector<float>(count);
    std::string rest = text.substr(place + mark.size(), 400);
    for (char& c : rest)
        if (c == ',' || c == '[' || c == '"' || c == '=') c = ' ';
    std::istringstream stream(rest);
    std::vector<float> values;
    for (float value; values.size() < count && stream >> value;) values.push_back(value);
    EXPECT_EQ(values.size(), count) << mark;
    values.resize(count);
    return values;
}
glm::vec3 vec3_after(const std::string& text, const std::string& mark) {
    const std::vector<float> v = numbers_after(text, mark, 3);
    return {v[0], v[1], v[2]};
}

Camera camera_of(float yfov) {
    Camera camera;
    camera.name = "a -- b <c>";
    camera.position = {1.0f, 2.0f, 3.0f};
    camera.forward = glm::normalize(glm::vec3(0.3f, -0.4f, -0.8f));
    camera.up = glm::normalize(glm::vec3(0.1f, 1.0f, 0.05f));
    camera.yfov = yfov;
    return camera;
}

class ExportTest : public ::testing::Test {
protected:
    std::string pbrt(const Scene& scene, const ExportedView& view) {
        notes = write_pbrt(folder.path() / "s.pbrt", scene, view);
        return text_of(folder.path() / "s.pbrt");
    }
    std::string mitsuba(const Scene& scene, const ExportedView& view) {
        notes = write_mitsuba(folder.path() / "s.xml", scene, view);
        return text_of(folder.path() / "s.xml");
    }
    TemporaryFolder folder;
    std::vector<std::string> notes;
};

// pbrt: camera from world = Scale(-1, 1, 1) LookAt, whose x axis is cross(up, direction), y up, z forward;
// the shorter side of the picture spans tan(fov / 2) at distance 1.
glm::vec2 pbrt_pixel(const std::string& text, glm::vec3 world, int width, int height) {
    const std::vector<float> v = numbers_after(text, "LookAt", 9);
    EXPECT_NE(text.find("Scale -1 1 1\nLookAt"), std::string::npos);
    const glm::vec3 eye(v[0], v[1], v[2]), z = glm::normalize(glm::vec3(v[3], v[4], v[5]) - eye),
                                           x = glm::normalize(glm::cross(glm::vec3(v[6], v[7], v[8]), z)),
                                           y = glm::cross(z, x);
    const glm::vec3 d = world - eye, seen(-glm::dot(d, x), glm::dot(d, y), glm::dot(d, z));
    glm::vec2 screen(seen.x, seen.y);
    glm::vec2 half;
    if (text.find("\"orthographic\"") != std::string::npos) {
        const std::vector<float> window = numbers_after(text, "screenwindow\"", 4);
        half = {window[1], window[3]};
    } else {
        const float t = std::tan(glm::radians(numbers_after(text, "\"float fov\"", 1)[0]) / 2.0f);
        const float aspect = float(width) / float(height);
        half = t * glm::vec2(std::max(aspect, 1.0f), std::max(1.0f / aspect, 1.0f));
        screen /= seen.z;
    }
    return {(screen.x / half.x * 0.5f + 0.5f) * float(width),
            (0.5f - screen.y / half.y * 0.5f) * float(height)};
}

// Mitsuba: columns left = cross(up, direction), up, direction; x grows to the left.
glm::vec2 mitsuba_pixel(const std::string& text, glm::vec3 world, int width, int height) {
    const glm::vec3 eye = vec3_after(text, "lookat origin"),
                    z = glm::normalize(vec3_after(text, "target") - eye),
                    x = glm::normalize(glm::cross(vec3_after(text, "up"), z)), y = glm::cross(z, x);
    const glm::vec3 d = world - eye;
    glm::vec2 screen(-glm::dot(d, x), glm::dot(d, y));
    const float aspect = float(width) / float(height);
    glm::vec2 half;
    if (text.find("\"orthographic\"") != std::string::npos) {
        const float scale = numbers_after(text, "<scale x", 1)[0];
        half = {scale, scale / aspect};
    } else {
        EXPECT_NE(text.find("name=\"fov_axis\" value=\"y\""), std::string::npos);
        const float t = std::tan(glm::radians(numbers_after(text, "name=\"fov\" value", 1)[0]) / 2.0f);
        half = {t * aspect, t};
        screen /= glm::dot(d, z);
    }
    return {(screen.x / half.x * 0.5f + 0.5f) * float(width),
            (0.5f - screen.y / half.y * 0.5f) * float(height)};
}

TEST_F(ExportTest, PointsFallOnTheSamePixels) {
    const Scene scene = load_scene("builtin:cornell");
    for (const auto& [width, height] : {std::pair(320, 200), std::pair(100, 240)})
        for (const float half_height : {0.0f, 1.5f}) {
            ExportedView view{camera_of(0.8f), width, height};
            view.camera.half_height = half_height;
            const std::string for_pbrt = pbrt(scene, view), for_mitsuba = mitsuba(scene, view);
            const CameraBasis b = camera_basis(view.camera, width, height);
            for (const glm::vec2 pixel :
                 {glm::vec2(3.5f, 7.5f), glm::vec2(60.0f, 180.0f), glm::vec2(50, 100)}) {
                glm::vec3 world = b.position + 2.5f * pixel_direction(b, width, height, pixel);
                if (half_height > 0.0f) {
                    // Parallel rays: half_height up and as much aspect to the right.
                    const glm::vec3 right = glm::normalize(glm::cross(view.camera.forward, view.camera.up)),
                                    up = glm::cross(right, view.camera.forward);
                    world = b.position + 2.5f * view.camera.forward +
                            half_height *
                                (right * (2 * pixel.x / float(width) - 1) * float(width) / float(height) -
                                 up * (2 * pixel.y / float(height) - 1));
                }
                EXPECT_LT(glm::length(pbrt_pixel(for_pbrt, world, width, height) - pixel), 0.01f);
                EXPECT_LT(glm::length(mitsuba_pixel(for_mitsuba, world, width, height) - pixel), 0.01f);
            }
        }
}

// Every tag is closed in turn, attributes are quoted, comments hold no "--".
void expect_well_formed(const std::string& xml) {
    std::vector<std::string> open;
    for (std::size_t i = xml.find('<'); i != xml.npos; i = xml.find('<', i + 1)) {
        if (xml.compare(i, 4, "<!--") == 0) {
            const std::size_t end = xml.find("--", i + 4);
            ASSERT_EQ(xml.compare(end, 3, "-->"), 0) << xml.substr(i, 80);
            i = end;
            continue;
        }
        const std::size_t end = xml.find('>', i);
        ASSERT_NE(end, xml.npos);
        const std::string tag = xml.substr(i + 1, end - i - 1);
        EXPECT_EQ(std::count(tag.begin(), tag.end(), '"') % 2, 0) << tag;
        EXPECT_EQ(tag.find_first_of("<&"), tag.npos) << tag;
        if (tag[0] == '?' || tag.back() == '/') continue;
        if (tag[0] != '/') {
            open.push_back(tag.substr(0, tag.find(' ')));
            continue;
        }
        ASSERT_FALSE(open.empty()) << tag;
        EXPECT_EQ("/" + open.back(), tag);
        open.pop_back();
    }
    EXPECT_TRUE(open.empty());
    EXPECT_EQ(xml.find("nan"), xml.npos);
    EXPECT_EQ(xml.find("inf,"), xml.npos);
}

TEST_F(ExportTest, EveryBuiltInSceneIsWellFormed) {
    for (const char* name :
         {"cornell", "shapes-spot", "shapes-directional", "glass-metal", "water", "tree"}) {
        const Scene scene = load_scene(std::string("builtin:") + name);
        const ExportedView view{scene.cameras.at(0), 64, 48};
        expect_well_formed(mitsuba(scene, view));
        const std::string text = pbrt(scene, view);
        EXPECT_EQ(std::count(text.begin(), text.end(), '"') % 2, 0) << name;
        EXPECT_EQ(std::count(text.begin(), text.end(), '['), std::count(text.begin(), text.end(), ']'))
            << name;
        EXPECT_EQ(text.find("nan"), text.npos) << name;
    }
}

TEST(ExportedSky, KeepsAreasAndDirections) {
    const auto expect = [](glm::vec2 square, glm::vec3 direction) {
        EXPECT_LT(glm::length(equal_area_direction(square) - direction), 1e-6f);
    };
    expect({0.5f, 0.5f}, {0, 0, 1});
    expect({1.0f, 0.5f}, {1, 0, 0});
    expect({0.0f, 0.5f}, {-1, 0, 0});
    expect({0.5f, 1.0f}, {0, 1, 0});
    expect({0.5f, 0.0f}, {0, -1, 0});
    expect({1.0f, 1.0f}, {0, 0, -1});
    // Equal areas: second moments of the sphere are 1/3, and a cap's share is (1 - cos) / 2.
    constexpr int n = 400;
    glm::dvec3 mean(0), second(0);
    int cap = 0;
    for (int i = 0; i < n * n; ++i) {
        const glm::vec3 d = equal_area_direction((glm::vec2(float(i % n), float(i / n)) + 0.5f) / float(n));
        EXPECT_NEAR(glm::length(d), 1.0f, 1e-5f);
        mean += glm::dvec3(d), second += glm::dvec3(d * d);
        cap += glm::dot(d, glm::normalize(glm::vec3(1, 2, -0.5f))) > 0.8f;
    }
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(mean[c] / (n * n), 0.0, 1e-4);
        EXPECT_NEAR(second[c] / (n * n), 1.0 / 3.0, 1e-3);
    }
    EXPECT_NEAR(double(cap) / (n * n), 0.1, 1e-3);
}

Environment noisy_environment() {
    Environment e;
    e.radiance = Image(128, 64, 3);
    std::mt19937 random(1);
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 128; ++x) {
            const float u = float(x) / 128.0f * 6.2831853f, v = float(y) / 64.0f * 3.14159265f;
            e.radiance.set_rgb(x, y,
                               glm::vec3(2 + std::sin(u) * std::sin(v), 2 + std::cos(v),
                                         1 + 0.5f * std::cos(u) * std::sin(v)));
        }
    e.rotation = 0.7f, e.scale = 2.5f;
    return e;
}

TEST(ExportedSky, HasTheEnergyOfTheMap) {
    const Environment e = noisy_environment();
    const Image sky = equal_area_sky(e);
    glm::dvec3 mean(0), truth(0);
    for (int y = 0; y < sky.height; ++y)
        for (int x = 0; x < sky.width; ++x) mean += glm::dvec3(sky.rgb(x, y)) / double(sky.pixels());
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 128; ++x)
            truth += glm::dvec3(e.radiance.rgb(x, y)) * double(e.scale * texel_solid_angle(e, y)) /
                     (4 * 3.14159265358979);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(mean[c] / truth[c], 1.0, 2e-3);
    // And each direction its radiance.
    for (const glm::vec2 place : {glm::vec2(0.3f, 0.6f), glm::vec2(0.9f, 0.2f), glm::vec2(0.05f, 0.5f)}) {
        const glm::vec3 here = sky.rgb(int(place.x * float(sky.width)), int(place.y * float(sky.height)));
        EXPECT_LT(glm::length(here - evaluate(e, equal_area_direction(place))), 0.05f * glm::length(here));
    }
}

// Mitsuba's envmap: u = atan2(x, -z) / (2 pi), v = acos(y) / pi in its own frame.
TEST(ExportedSky, TurnsMitsubasMap) {
    const Environment e = noisy_environment();
    const float angle = -glm::radians(mitsuba_sky_angle(e));
    std::mt19937 random(3);
    std::normal_distribution<float> normal;
    for (int i = 0; i < 100; ++i) {
        const glm::vec3 d = glm::normalize(glm::vec3(normal(random), normal(random), normal(random)));
        const glm::vec3 own(std::cos(angle) * d.x + std::sin(angle) * d.z, d.y,
                            -std::sin(angle) * d.x + std::cos(angle) * d.z);
        const glm::vec2 uv(std::atan2(own.x, -own.z) / 6.2831853f, std::acos(own.y) / 3.14159265f);
        const glm::vec2 ours = environment_uv(e, d);
        const float across = std::abs(uv.x - ours.x - std::round(uv.x - ours.x));
        EXPECT_LT(across, 1e-4f);
        EXPECT_NEAR(uv.y, ours.y, 1e-4f);
    }
}

struct Ply {
    std::vector<glm::vec3> positions;
    std::vector<glm::uvec3> triangles;
};
Ply read_ply(const std::string& bytes) {
    const auto count_of = [&](const char* element) {
        return std::size_t(numbers_after(bytes, std::string("element ") + element, 1)[0]);
    };
    const std::size_t stride = bytes.find("property float nx") != bytes.npos ? 6 : 3,
                      uvs = bytes.find("property float u") != bytes.npos ? 2 : 0;
    const char* data = bytes.data() + bytes.find("end_header\n") + 11;
    Ply ply;
    for (std::size_t i = 0; i < count_of("vertex"); ++i, data += 4 * (stride + uvs)) {
        ply.positions.emplace_back();
        std::memcpy(&ply.positions.back(), data, 12);
    }
    for (std::size_t i = 0; i < count_of("face"); ++i, data += 13) {
        EXPECT_EQ(*data, 3);
        ply.triangles.emplace_back();
        std::memcpy(&ply.triangles.back(), data + 1, 12);
    }
    EXPECT_EQ(data, bytes.data() + bytes.size());
    return ply;
}

// One triangle that emits along +z in object space; mirrored at x = 0 it still does, in the world.
TEST_F(ExportTest, TheFrontOfAMirroredEmitterStaysItsFront) {
    Scene scene;
    scene.materials.resize(1);
    scene.materials[0].emission = {3, 2, 1}, scene.materials[0].metallic = scene.materials[0].specular = 0.0f;
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.normals.assign(3, {0, 0, 1});
    mesh.indices = {0, 1, 2};
    scene.meshes = {mesh};
    Instance straight, mirrored;
    mirrored.transform[0].x = -1.0f, mirrored.transform[3].z = 5.0f;
    scene.instances = {straight, mirrored};
    const std::string text = pbrt(scene, {camera_of(0.8f), 8, 8});
    EXPECT_NE(text.find("AreaLightSource \"diffuse\" \"rgb L\" [3 2 1]\n"), text.npos);
    EXPECT_EQ(text.find("twosided"), text.npos);
    for (const char* name : {"s-mesh-0.ply", "s-instance-1.ply"}) {
        const Ply ply = read_ply(text_of(folder.path() / name));
        ASSERT_EQ(ply.triangles.size(), 1u);
        const glm::uvec3 t = ply.triangles[0];
        const glm::vec3 n =
            glm::cross(ply.positions[t.y] - ply.positions[t.x], ply.positions[t.z] - ply.positions[t.x]);
        EXPECT_GT(n.z, 0.5f) << name;
    }
    EXPECT_EQ(read_ply(text_of(folder.path() / "s-instance-1.ply")).positions[1], glm::vec3(-1, 0, 5));
    const std::string xml = mitsuba(scene, {camera_of(0.8f), 8, 8});
    EXPECT_NE(xml.find("<emitter type=\"area\"><rgb name=\"radiance\" value=\"3, 2, 1\"/></emitter>"),
              xml.npos);
    EXPECT_NE(xml.find("face_normals"), xml.npos);
    EXPECT_TRUE(notes.empty());
}

// White light that went 2 m through the inside has the color (.25, .5, 1): sigma = -ln(color) / 2.
TEST_F(ExportTest, GlassAbsorbsByBeersLaw) {
    Scene scene = load_scene("builtin:glass-sphere");
    for (Material& m : scene.materials)
        if (m.transmission > 0.0f) m.attenuation_color = {0.25f, 0.5f, 1.0f}, m.attenuation_distance = 2.0f;
    const ExportedView view{scene.cameras.at(0), 8, 8};
    const glm::vec3 sigma(std::log(4.0f) / 2.0f, std::log(2.0f) / 2.0f, 0.0f);
    EXPECT_LT(glm::length(vec3_after(pbrt(scene, view), "rgb sigma_a\"") - sigma), 1e-6f);
    EXPECT_LT(glm::length(vec3_after(mitsuba(scene, view), "sigma_t\" value") - sigma), 1e-6f);
}

TEST_F(ExportTest, WhatIsLostIsCounted) {
    Scene scene = load_scene("builtin:cornell");
    for (Material& m : scene.materials) m.clearcoat = 1.0f;
    const ExportedView view{scene.cameras.at(0), 8, 8};
    const std::string text = pbrt(scene, view);
    const auto counted = std::find_if(notes.begin(), notes.end(), [](const std::string& note) {
        return note.starts_with("clear coats: left out (") && note.ends_with(" times)");
    });
    ASSERT_NE(counted, notes.end());
    EXPECT_NE(text.find("# approximated: " + *counted + "\n"), text.npos);
}

// Textures are turned upside down for pbrt alone, hold their factors, and cut alpha where the material does.
TEST_F(ExportTest, PicturesHoldTheirFactors) {
    Scene scene;
    Texture texture;
    texture.srgb = true;
    texture.pixels.width = 2, texture.pixels.height = 1;
    texture.pixels.rgba = {255, 255, 255, 255, 188, 188, 188, 100}; // 188: half the light
    scene.textures = {texture};
    scene.materials.resize(1);
    Material& m = scene.materials[0];
    m.base_color = {0.5f, 1.0f, 1.0f, 1.0f}, m.metallic = 0.0f, m.specular = 0.0f;
    m.base_color_texture.texture = 0;
    m.alpha_mode = AlphaMode::mask;
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.normals.assign(3, {0, 0, 1});
    mesh.texcoords[0] = {{0, 0.25f}, {1, 0.25f}, {0, 0.75f}};
    mesh.indices = {0, 1, 2};
    scene.meshes = {mesh};
    scene.instances.resize(1);
    pbrt(scene, {camera_of(0.8f), 8, 8});
    const Image color = read_image(folder.path() / "s-0-color.png");
    EXPECT_NEAR(color.rgb(0, 0).r, 0.5f, 0.005f);
    EXPECT_NEAR(color.rgb(1, 0).r, 0.25f, 0.005f);
    EXPECT_NEAR(color.rgb(1, 0).g, 0.5f, 0.005f);
    const Image coverage = read_image(folder.path() / "s-0-coverage.png");
    EXPECT_EQ(coverage.rgb(0, 0).r, 1.0f);
    EXPECT_EQ(coverage.rgb(1, 0).r, 0.0f);
    const auto v_of = [&] {
        const std::string bytes = text_of(folder.path() / "s-mesh-0.ply");
        float v;
        std::memcpy(&v, bytes.data() + bytes.find("end_header\n") + 11 + 28, 4);
        return v;
    };
    EXPECT_EQ(v_of(), 0.75f);
    mitsuba(scene, {camera_of(0.8f), 8, 8});
    EXPECT_EQ(v_of(), 0.25f);
}

} // namespace
} // namespace luxel
