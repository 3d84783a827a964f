// SPDX-License-Identifier: MIT
// Scene files: the documented example, every kind of slip, and that nothing outside the folder is opened.
#include "scene/scene_file.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>

#include <gtest/gtest.h>

#include "core/error.h"
#include "core/file.h"
#include "core/image_io.h"
#include "scene/lights.h"
#include "support/build_folders.h"
#include "support/data.h"

namespace luxel {
namespace {

// A folder of its own for each test, removed at the end.
class SceneFile : public ::testing::Test {
protected:
    void SetUp() override {
        const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
        folder_ = std::filesystem::path(LUXEL_BINARY_DIR) / "scene_file_test" / info->name();
        std::filesystem::remove_all(folder_);
        std::filesystem::create_directories(folder_ / "models");
        write("models/lamp.obj", "o lamp\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    }
    void TearDown() override { std::filesystem::remove_all(folder_); }

    void write(const std::string& name, const std::string& text) {
        std::ofstream(folder_ / name, std::ios::binary) << text;
    }
    Scene load(const std::string& toml) {
        write("scene.toml", toml);
        return load_scene((folder_ / "scene.toml").string());
    }
    // The sentence that loading ends with.
    std::string error_of(const std::string& toml) {
        try {
            load(toml);
        } catch (const Error& error) {
            EXPECT_EQ(error.fault(), Fault::bad_input) << error.what();
            EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
            return error.what();
        }
        ADD_FAILURE() << "no error for " << toml.substr(0, 200);
        return "";
    }
    void expect_error(const std::string& toml, const std::string& line, const std::string& reason) {
        const std::string sentence = error_of(toml);
        EXPECT_NE(sentence.find("scene.toml"), std::string::npos) << sentence;
        EXPECT_NE(sentence.find(line), std::string::npos) << sentence;
        EXPECT_NE(sentence.find(reason), std::string::npos) << sentence;
    }

    std::filesystem::path folder_;
};

// Flat (uncompressed) Radiance pixels: mantissa 128 with exponent 129 is 1.
std::string white_hdr(int width, int height) {
    std::string file = fmt::format("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {} +X {}\n", height, width);
    for (int i = 0; i < width * height; ++i) file += "\x80\x80\x80\x81";
    return file;
}

const std::string cornell_line = "geometry = \"builtin:cornell\"\n";

float largest_emission(const Scene& scene) {
    float most = 0.0f;
    for (const EmissiveTriangle& e : emissive_triangles(scene)) most = std::max(most, e.emission.r);
    return most;
}

const Instance& instance_named(const Scene& scene, const std::string& name) {
    for (const Instance& instance : scene.instances)
        if (instance.name == name) return instance;
    throw std::out_of_range(name);
}

const Material& material_of(const Scene& scene, const std::string& name) {
    const Mesh& mesh = scene.meshes[std::size_t(instance_named(scene, name).mesh)];
    return scene.materials[std::size_t(mesh.material)];
}

TEST_F(SceneFile, TheDocumentedExampleLoads) {
    const auto bytes = read_file(std::filesystem::path(LUXEL_SOURCE_DIR) / "docs/scene-file.md");
    const std::string page(bytes.begin(), bytes.end());
    const std::size_t begin = page.find("```toml\n") + 8, end = page.find("```", begin);
    ASSERT_NE(end, std::string::npos);
    write("sky.hdr", white_hdr(4, 2));
    const Scene scene = load(page.substr(begin, end - begin));

    EXPECT_EQ(scene.name, "room with a lamp");
    EXPECT_EQ(scene.triangles(), 37u);
    ASSERT_EQ(scene.lights.size(), 3u);
    EXPECT_EQ(scene.lights[0].type, shared::LIGHT_POINT);
    EXPECT_EQ(scene.lights[0].range, 20.0f);
    EXPECT_EQ(scene.lights[1].intensity, glm::vec3(12.0f));
    EXPECT_NEAR(scene.lights[1].outer, 1.0f - std::cos(shared::PI / 6), 1e-6f);
    EXPECT_LT(glm::length(scene.lights[1].direction - glm::normalize(glm::vec3(-0.8f, -1.9f, -0.8f))), 1e-6f);
    EXPECT_EQ(scene.lights[2].type, shared::LIGHT_DIRECTIONAL);

    ASSERT_EQ(scene.cameras.size(), 1u);
    EXPECT_EQ(scene.cameras[0].name, "front");
    EXPECT_EQ(scene.cameras[0].forward, glm::vec3(0, 0, -1));
    EXPECT_NEAR(scene.cameras[0].yfov, 32 * shared::PI / 180, 1e-6f);
    EXPECT_NEAR(evaluate(scene.environment, {0, 1, 0}).r, 0.5f, 1.0f / 256); // a mantissa's last bit

    EXPECT_EQ(instance_named(scene, "left wall").role, "enclosure");
    EXPECT_EQ(instance_named(scene, "floor").role, "");
    EXPECT_EQ(material_of(scene, "short box").metallic, 1.0f);
    EXPECT_EQ(material_of(scene, "tall box").metallic, 0.0f);
    EXPECT_EQ(largest_emission(scene), 0.0f);
}

TEST_F(SceneFile, PlacesGeometry) {
    const Scene scene = load("[[geometry]]\nfile = \"models/lamp.obj\"\ntranslate = [1, 2, 3]\n"
                             "rotate_degrees = [0, 90, 0]\nscale = [2, 4, 1]\n");
    const Mesh& mesh = scene.meshes[0];
    const auto world = [&](glm::vec3 p) { return glm::vec3(scene.instances[0].transform * glm::vec4(p, 1)); };

    // A quarter turn about y carries x to -z.
    EXPECT_LT(glm::length(world(mesh.positions[1]) - glm::vec3(1, 2, 1)), 1e-5f);
    EXPECT_LT(glm::length(world(mesh.positions[2]) - glm::vec3(1, 6, 3)), 1e-5f);
    EXPECT_EQ(scene.warnings.size(), 2u); // no camera, no light
}

TEST_F(SceneFile, PlacesLightsAndCamerasOfGeometry) {
    const Scene scene = load("[[geometry]]\nfile = \"builtin:shapes-spot\"\ntranslate = [10, 0, 0]\n"
                             "rotate_degrees = [0, 0, 90]\nscale = 2\n");
    const glm::vec3 lamp(1.2f, 3.2f, 2.0f), toward = glm::normalize(-lamp);
    EXPECT_LT(glm::length(scene.lights[0].position - glm::vec3(10 - 6.4f, 2.4f, 4.0f)), 1e-5f);
    EXPECT_LT(glm::length(scene.lights[0].direction - glm::vec3(-toward.y, toward.x, toward.z)), 1e-5f);
    EXPECT_LT(glm::length(scene.cameras[0].position - glm::vec3(10 - 5.2f, 0, 11.2f)), 1e-5f);
    EXPECT_LT(glm::length(scene.cameras[0].up - glm::vec3(-1, 0, 0)), 1e-5f);
}

TEST_F(SceneFile, MergesAndReplaces) {
    const std::string two =
        "[[geometry]]\nfile = \"builtin:shapes\"\n[[geometry]]\nfile = \"builtin:cornell\"\n"
        "[[light]]\ntype = \"point\"\nposition = [0, 1, 0]\nintensity = 1\n"
        "[[camera]]\nposition = [0, 1, 5]\nforward = [0, 0, -1]\n";
    const Scene both = load(two);
    EXPECT_EQ(both.lights.size(), 2u);
    ASSERT_EQ(both.cameras.size(), 3u);
    EXPECT_EQ(both.cameras[0].name, "camera 1");
    EXPECT_EQ(material_of(both, "left wall").base_color.r, 0.63f);
    EXPECT_EQ(material_of(both, "cone").base_color.r, 0.7f);

    const Scene replaced = load("replace_lights = true\nreplace_cameras = true\n" + two);
    EXPECT_EQ(replaced.lights.size(), 1u);
    EXPECT_EQ(replaced.cameras.size(), 1u);
}

TEST_F(SceneFile, ObjectRulesSplitSharedMaterials) {
    // Two objects share a material; a rule for one of them must leave the other alone.
    write("two.obj",
          "mtllib two.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\no a\nusemtl m\nf 1 2 3\no b\nusemtl m\nf 1 3 2\n");
    write("two.mtl", "newmtl m\nKd 0.5 0.5 0.5\n");
    const Scene scene =
        load("geometry = \"two.obj\"\n[[object]]\nname = \"a*\"\nemission = [3, 2, 1]\nior = 1.3\n");
    int emitting = 0;
    for (const Instance& instance : scene.instances) {
        const Material& m = scene.materials[std::size_t(scene.meshes[std::size_t(instance.mesh)].material)];
        emitting += m.emission == glm::vec3(3, 2, 1) && m.ior == 1.3f;
    }
    EXPECT_EQ(emitting, 1);
    EXPECT_EQ(scene.instances.size(), 2u);
}

std::string gray_png(float value) {
    const std::vector<std::uint8_t> bytes = encode_png(Image(2, 2, 3, value));
    return {bytes.begin(), bytes.end()};
}

TEST_F(SceneFile, HeightMapsAreReadBeneathTheFolder) {
    write("models/height.png", gray_png(0.4f));
    const std::string rule = cornell_line + "[[object]]\nname = \"floor\"\nheight_map = ";
    const Scene scene = load(rule + "\"models/height.png\"\nheight_scale = 0.05\n");
    const Material& floor = material_of(scene, "floor");
    ASSERT_TRUE(floor.has_relief());
    EXPECT_EQ(floor.height_scale, 0.05f);
    EXPECT_EQ(scene.textures[std::size_t(floor.height_texture.texture)].pixels.rgba[0], 102);
    EXPECT_FALSE(scene.textures[0].srgb);
    EXPECT_FALSE(material_of(scene, "ceiling").has_relief());

    // One file, one texture.
    const Scene two = load(rule + "\"models/height.png\"\nheight_scale = 0.05\n[[object]]\nname = \"*wall\"\n"
                                  "height_map = \"models/height.png\"\nheight_scale = 0.1\n");
    EXPECT_EQ(two.textures.size(), 1u);
    EXPECT_EQ(material_of(two, "left wall").height_scale, 0.1f);

    expect_error(rule + "\"models/none.png\"\nheight_scale = 0.05\n", "4", "does not exist");
    expect_error(rule + "\"models/height.png\"\n", "4", "together");
    EXPECT_NE(error_of(rule + "\"../height.png\"\nheight_scale = 0.05\n").find("leaves the folder"),
              std::string::npos);
    expect_error(rule + "\"models/height.png\"\nheight_scale = 0\n", "5", "height_scale");
    expect_error("geometry = \"models/lamp.obj\"\n[[object]]\nname = \"lamp\"\n"
                 "height_map = \"models/height.png\"\nheight_scale = 0.05\n",
                 "4", "texture coordinates");
    write("models/height.png", "no image");
    EXPECT_NE(error_of(rule + "\"models/height.png\"\nheight_scale = 0.05\n").find("height.png"),
              std::string::npos);
}

TEST_F(SceneFile, ImpostorsHaveAMeasureOfErrorEach) {
    const std::string rule = cornell_line + "[[object]]\nname = \"*box\"\nimpostor = ";
    const Scene scene = load(rule + "\"nailboard\"\nimpostor_size = 64\nimpostor_error = 2\n"
                                    "[[object]]\nname = \"tall box\"\nimpostor = \"billboard_cloud\"\n"
                                    "impostor_distance = 0.05\n");
    for (const Instance& i : scene.instances) {
        Impostor expected;
        if (i.name == "short box") expected = {.kind = ImpostorKind::nailboard, .size = 64, .error = 2.0f};
        if (i.name == "tall box") expected = {.kind = ImpostorKind::billboard_cloud, .distance = 0.05f};
        EXPECT_EQ(i.impostor, expected) << i.name;
    }
    const Scene none = load(rule + "\"billboard\"\n[[object]]\nname = \"*\"\nimpostor = \"none\"\n");
    for (const Instance& i : none.instances) EXPECT_EQ(i.impostor.kind, ImpostorKind::none);

    expect_error(rule + "\"sprite\"\n", "line 4", "none of billboard, nailboard");
    expect_error(rule + "\"billboard_cloud\"\n", "line 4", "needs \"impostor_distance\"");
    expect_error(rule + "\"billboard\"\nimpostor_distance = 1\n", "line 5", "billboard_cloud");
    expect_error(rule + "\"none\"\nimpostor_error = 1\n", "line 5", "billboard or a nailboard");
    expect_error(rule + "\"billboard\"\nimpostor_size = 4\n", "line 5", "impostor_size");
}

TEST_F(SceneFile, SkyGradient) {
    const Scene scene =
        load(cornell_line +
             "[environment]\nsky = { horizon = 1, zenith = [0, 0, 4], ground = 0.25 }\nscale = 2\n");
    EXPECT_EQ(evaluate(scene.environment, {0, -1, 0}), glm::vec3(0.5f));
    EXPECT_GT(evaluate(scene.environment, {0, 1, 0}).b, 7.5f);
}

TEST_F(SceneFile, SlipsNameTheirLine) {
    const std::string light = cornell_line + "[[light]]\n", camera = cornell_line + "[[camera]]\n";
    expect_error(cornell_line + "geomtry = 3\n", "line 2", "unknown key \"geomtry\"; known are");
    expect_error(light + "type = \"point\"\nposition = [0, 1, 0]\nintensity = 1\ninner_degrees = 3\n",
                 "line 6", "unknown key \"inner_degrees\"; known are type, intensity, position, range");
    expect_error(light + "type = \"area\"\nintensity = 1\n", "line 3", "known are point, spot, directional");
    expect_error(light + "type = \"point\"\nintensity = 1\n", "line 3", "needs \"position\"");
    expect_error(light + "type = \"directional\"\nintensity = 1\n", "line 3", "needs \"direction\"");
    expect_error(light + "type = \"directional\"\nintensity = -1\n", "line 4", "not within");
    expect_error(light + "type = \"directional\"\nintensity = nan\n", "line 4", "not within");
    expect_error(light + "type = \"directional\"\nintensity = [1, 2]\n", "line 4", "[x, y, z]");
    expect_error(light + "type = \"directional\"\nintensity = 1\ndirection = [0, 0, 0]\n", "line 5",
                 "no length");
    expect_error(light + "type = \"spot\"\nposition = [0,1,0]\ntarget = [0,0,0]\nintensity = 1\n"
                         "inner_degrees = 50\nouter_degrees = 40\n",
                 "line 7", "above");
    expect_error(camera + "position = [0, 0, 0]\n", "line 3", "needs \"forward\" or \"target\"");
    expect_error(camera + "position = [0, 0, 0]\ntarget = [0, 5, 0]\n", "line 2", "along its \"up\"");
    expect_error(camera + "position = [0, 0, 0]\ntarget = [0, 0, 5]\nforward = [0, 0, 1]\n", "line 4",
                 "not both");
    expect_error(cornell_line + "[environment]\nscale = 1\n", "line 2", "either \"file\" or \"sky\"");
    expect_error(cornell_line + "[environment]\nsky = { horizon = 1 }\n", "line 3", "\"zenith\" is missing");
    expect_error(cornell_line + "[[object]]\nname = \"sofa\"\nrole = \"x\"\n", "line 3",
                 "there are floor, ceiling");
    expect_error(cornell_line + "[[object]]\nname = \"floor\"\n", "line 3", "changes nothing");
    expect_error("name = \"x\"\n", "line 1", "\"geometry\" is missing");
    expect_error("geometry = 4\n", "line 1", "[[geometry]]");
    expect_error("geometry = \"a.gltf\n", "line 1", "");
    expect_error("[[geometry]]\nfile = \"models/lamp.obj\"\nscale = 0\n", "line 3", "not within");
}

TEST_F(SceneFile, NothingOutsideTheFolderIsOpened) {
    write("../outside.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    expect_error("geometry = \"../outside.obj\"\n", "line 1", "leaves the scene file's folder");
    expect_error("geometry = \"models/../../outside.obj\"\n", "line 1", "leaves the scene file's folder");
    expect_error("geometry = \"/etc/passwd.obj\"\n", "line 1", "no path within");
    std::filesystem::create_symlink("../outside.obj", folder_ / "link.obj");
    expect_error("geometry = \"link.obj\"\n", "line 1", "symbolic link");
    EXPECT_NE(error_of(cornell_line + "[environment]\nfile = \"../sky.hdr\"\n").find("leaves"),
              std::string::npos);
    expect_error(cornell_line + "[environment]\nfile = \"absent.hdr\"\n", "line 3", "does not exist");
    EXPECT_NE(error_of("geometry = \"scene.toml\"\n").find("unknown kind"), std::string::npos);
}

TEST_F(SceneFile, DataIsReadBeneathTheFolderThatTheUserNames) {
    const LoadOptions options = {.data = (folder_ / "models").string()};
    write("scene.toml", "geometry = \"data:lamp.obj\"\n");
    const std::string file = (folder_ / "scene.toml").string();
    EXPECT_EQ(load_scene(file, options).triangles(), 1u);
    expect_error("geometry = \"data:lamp.obj\"\n", "line 1", "needs --data DIR");
    write("scene.toml", "geometry = \"data:../models/lamp.obj\"\n");
    EXPECT_THROW(load_scene(file, options), Error);
    write("scene.toml", "geometry = \"data:/etc/passwd.obj\"\n");
    EXPECT_THROW(load_scene(file, options), Error);
}

// Everything moved by the same coordinates of a national grid is the same scene, to less than a millimeter.
TEST_F(SceneFile, ScenesFarAwayAreTheSame) {
    const auto at = [this](const std::string& x, const std::string& height) {
        return load("[[geometry]]\nfile = \"models/lamp.obj\"\ntranslate = [" + x + ".25, 0, 0]\n" +
                    "[[geometry]]\nfile = \"models/lamp.obj\"\ntranslate = [" + x + ".5, 0.001, 0]\n" +
                    "[[light]]\ntype = \"point\"\nintensity = 1\nposition = [" + x + ".75, 2, 0]\n" +
                    "[[camera]]\nposition = [" + x + ".125, 0, 3]\ntarget = [" + x + ".125, 0, 0]\n" +
                    height);
    };
    const Scene near = at("0", ""), far = at("500000", "orthographic_height = 4.0\n");
    EXPECT_EQ(near.origin, glm::dvec3(0.0));
    EXPECT_NEAR(far.origin.x, 500000.0, 2.0);
    const float by = float(500000.0 - far.origin.x);
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_NEAR(far.instances[i].transform[3].x - by, near.instances[i].transform[3].x, 1e-6f);
        EXPECT_NEAR(far.instances[i].transform[3].y + float(far.origin.y), near.instances[i].transform[3].y,
                    1e-7f);
    }
    EXPECT_NEAR(far.lights[0].position.x - by, 0.75f, 1e-6f);
    EXPECT_NEAR(far.cameras[0].position.x - by, 0.125f, 1e-6f);
    EXPECT_EQ(far.cameras[0].forward, glm::vec3(0, 0, -1));
    EXPECT_EQ(far.cameras[0].half_height, 2.0f);
    EXPECT_EQ(far.cameras[0].near, 0.0f);
    EXPECT_FALSE(near.cameras[0].orthographic());
    EXPECT_LT(near.cameras[0].near, 0.0011f); // a thousandth of the scene's radius
    EXPECT_TRUE(std::isinf(near.cameras[0].far));
}

// The scene files of the repository, where their data are.
TEST(Scenes, LoadWithTheirData) {
    const std::map<std::string, std::size_t> triangles = {{"ring", 202},
                                                          {"water_room", 1932},
                                                          {"bunnies_ring", 202 + 3 * 69451},
                                                          {"water_caustic", 103487},
                                                          {"teapot_glass", 126744},
                                                          {"sponza_pools", 262267 + 3 * (4 * 12 + 2 + 8192)}};
    LUXEL_DATA_OR_SKIP(probe, "sponza_crytek/sponza_crytek.gltf");
    const LoadOptions options = {.data = probe.parent_path().parent_path().string()};
    for (const auto& [name, count] : triangles) {
        const Scene scene = load_scene(std::string(LUXEL_SOURCE_DIR) + "/scenes/" + name + ".toml", options);
        EXPECT_EQ(scene.triangles(), count) << name;
        ASSERT_EQ(scene.lights.size(), 1u) << name;
        EXPECT_EQ(scene.lights[0].type, shared::LIGHT_SPOT) << name;
        EXPECT_TRUE(emissive_triangles(scene).empty()) << name;
        EXPECT_TRUE(std::any_of(scene.instances.begin(), scene.instances.end(), [](const Instance& instance) {
            return instance.role.starts_with("specular");
        })) << name;
    }
}

TEST_F(SceneFile, HostileTextIsRefused) {
    expect_error("a = " + std::string(200000, '['), "line 1", "");
    expect_error(std::string(2000, 'a') + std::string(100000, '.') + "b = 1", "line 1", "dots");
    std::string chain = "a";
    for (int i = 0; i < 60000; ++i) chain += ".a";
    expect_error(chain + " = 1", "line 1", "dots");
    expect_error(std::string(300 << 10, '#'), "", "limit");
    expect_error(std::string("\0\xff\xfe", 3), "line 1", "");

    // The deepest nesting that the two limits admit must neither crash the parser nor its cleanup.
    std::string deep, key = "a";
    for (int i = 0; i < 63; ++i) key += ".a";
    for (int i = 0; i < 1900; ++i) deep += key + " = [{\n";
    error_of(deep);
}

TEST(Glob, Matches) {
    EXPECT_TRUE(matches_glob("", ""));
    EXPECT_TRUE(matches_glob("*", ""));
    EXPECT_TRUE(matches_glob("sofa", "sofa"));
    EXPECT_TRUE(matches_glob("s?fa*", "sofa_1"));
    EXPECT_TRUE(matches_glob("*a*b", "xaab ab"));
    EXPECT_FALSE(matches_glob("?", ""));
    EXPECT_FALSE(matches_glob("sofa", "sofa_1"));
    EXPECT_FALSE(matches_glob("*a?", "xxa"));
    std::string stars;
    for (int i = 0; i < 1000; ++i) stars += "*a";
    EXPECT_FALSE(matches_glob(stars + "b", std::string(20000, 'a')));
}

} // namespace
} // namespace luxel
